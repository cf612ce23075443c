// SPDX-License-Identifier: Apache-2.0
// Beams in random scenes of boxes, sheets and slivers, compared with brute force: no path is missing, none is invented.
// WAVETRACER_RANDOM_SCENES=300 tries as many scenes as that.
#include <algorithm>
#include <cstdlib>

#include "passes/triangles.hpp"
#include "reference/brute_force.hpp"
#include "simulation/buildings.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

uint32_t scene_count() {
  const char* const asked = std::getenv("WAVETRACER_RANDOM_SCENES");
  return asked ? static_cast<uint32_t>(std::atoi(asked)) : 8;
}

// Boxes stand upright on z = 0 at any angle; sheets lie at any slope; slivers are a thousandth as wide as long.
std::vector<Quad> random_scene(Random& random) {
  std::vector<Quad> out;
  if (random() < 0.7) out.push_back({{-15, -15, 0}, {30, 0, 0}, {0, 30, 0}});
  const uint32_t boxes = random.below(3), sheets = 1 + random.below(4), slivers = random.below(3);
  for (uint32_t i = 0; i < boxes; ++i) {
    const double turn = random.between(0, 1.5), width = random.between(1, 6), depth = random.between(1, 6);
    const glm::dvec3 corner{random.between(-9, 7), random.between(-9, 7), 0};
    const std::vector<Quad> box = building(corner, turn, width, depth, random.between(1, 7));
    out.insert(out.end(), box.begin(), box.end());
  }
  for (uint32_t i = 0; i < sheets + slivers; ++i) {
    const glm::dvec3 u = random.between(2, 8) * random.direction(),
                     v = (i < sheets ? random.between(2, 8) : 0.006) * random.direction();
    if (glm::length(glm::cross(u, v)) > 0.5 * glm::length(u) * glm::length(v))
      out.push_back({random.in_cube(6) + glm::dvec3{0, 0, 6.5}, u, v});
  }
  if (out.empty()) out.push_back({{-3, -3, 5}, {7, 1, 0}, {0, 8, 2}});
  return out;
}

// Link, number of reflections and length of each path, sorted.
using Known = std::tuple<uint32_t, uint32_t, uint32_t, double>;

std::vector<Known> by_brute_force(const Scene& scene, Points from, Points to, const reference::Limits& limits) {
  for (Points* const points : {&from, &to})
    for (glm::dvec3& p : *points) p -= scene.origin_m;
  const PathGeometry paths = reference::brute_force_all(scene, from, to, limits);
  std::vector<Known> out;
  for (size_t i = 0; i < paths.size(); ++i)
    out.emplace_back(paths.tx[i], paths.rx[i], static_cast<uint32_t>(paths.first[i + 1] - paths.first[i]),
                     reference::path_length_m(paths, i, from[paths.tx[i]], to[paths.rx[i]]));
  std::ranges::sort(out);
  return out;
}

std::vector<Known> by_beams(Simulation& simulation) {
  const Paths paths = simulation.run_frame(0).paths;
  std::vector<Known> out;
  for (size_t i = 0; i < paths.size(); ++i)
    out.emplace_back(paths.tx[i], paths.rx[i], paths.depth[i], paths.delay_s[i] * speed_of_light);
  std::ranges::sort(out);
  return out;
}

// Compares all paths of `count` scenes, and returns their number.
size_t compare(uint32_t count, const reference::Limits& limits) {
  size_t paths = 0;
  for (uint32_t seed = 1; seed <= count; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const SceneFile file(random_scene(random));
    Points from, to;
    for (int i = 0; i < 2; ++i) from.push_back(random.in_cube(7) + glm::dvec3{0, 0, 7.3});
    for (int i = 0; i < 6; ++i) to.push_back(random.in_cube(7) + glm::dvec3{0, 0, 7.3});
    Config config = config_of(file.path(), from, to, 1000, limits.max_depth);
    config.trace.discovery = "beams";
    config.trace.diffraction = limits.diffraction;
    Simulation simulation(config);
    const std::vector<Known> expected = by_brute_force(simulation.scene(), from, to, limits),
                             found = by_beams(simulation);
    paths += expected.size();
    CHECK(found.size() == expected.size());
    if (found.size() != expected.size()) continue;
    for (size_t i = 0; i < found.size(); ++i) {
      const auto& [tx, rx, depth, length] = found[i];
      CHECK(std::tuple{tx, rx, depth} ==
            std::tuple{std::get<0>(expected[i]), std::get<1>(expected[i]), std::get<2>(expected[i])});
      CHECK(length == doctest::Approx(std::get<3>(expected[i])).epsilon(1e-9));
    }
  }
  return paths;
}

}  // namespace

TEST_CASE("beams find the paths of brute force in random scenes of boxes, sheets and slivers, order 3") {
  CHECK(compare(scene_count(), {.max_depth = 3}) > 10 * scene_count());
}

TEST_CASE("the same with a diffraction, order 2") {
  const uint32_t count = (scene_count() + 2) / 3;
  CHECK(compare(count, {.max_depth = 2, .diffraction = true}) > 30 * count);
}
