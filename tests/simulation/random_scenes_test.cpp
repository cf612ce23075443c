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

// Boxes stand upright at any angle, on the ground z = 0 if there is one; else their lowest edges are in planes of their
// own, since a leg in such a plane would pass the edges of another box exactly. sheets lie at any slope; slivers are a
// thousandth as wide as long.
std::vector<Quad> random_scene(Random& random) {
  std::vector<Quad> out;
  const bool ground = random() < 0.7;
  if (ground) out.push_back({{-15, -15, 0}, {30, 0, 0}, {0, 30, 0}});
  const uint32_t boxes = random.below(3), sheets = 1 + random.below(4), slivers = random.below(3);
  for (uint32_t i = 0; i < boxes; ++i) {
    const double turn = random.between(0, 1.5), width = random.between(1, 6), depth = random.between(1, 6);
    const glm::dvec3 corner{random.between(-9, 7), random.between(-9, 7), ground ? 0 : random.between(-1, 0)};
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

// Does a path run along the plane of a surface that it is reflected by? Rounding decides whether that is a path.
bool runs_along_a_mirror(const Scene& scene, const PathGeometry& paths, size_t i, const Points& from,
                         const Points& to) {
  for (size_t k = paths.first[i]; k < paths.first[i + 1]; ++k) {
    if (paths.interaction[k] != reflection) continue;
    const Surface& surface = scene.surfaces[paths.surface[k]];
    const auto height = [&](const glm::dvec3& p) { return std::abs(glm::dot(surface.normal, p) - surface.offset_m); };
    const glm::dvec3 last = k == paths.first[i] ? from[paths.tx[i]] : paths.vertex[k - 1];
    const glm::dvec3 next = k + 1 == paths.first[i + 1] ? to[paths.rx[i]] : paths.vertex[k + 1];
    if (std::min(height(last), height(next)) < 1e-9) return true;
  }
  return false;
}

std::vector<Known> by_brute_force(const Scene& scene, Points from, Points to, const reference::Limits& limits) {
  for (Points* const points : {&from, &to})
    for (glm::dvec3& p : *points) p -= scene.origin_m;
  const PathGeometry paths = reference::brute_force_all(scene, from, to, limits);
  std::vector<Known> out;
  for (size_t i = 0; i < paths.size(); ++i)
    if (!runs_along_a_mirror(scene, paths, i, from, to))
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

// Places of a few ends among the walls.
Points places(Random& random, int count) {
  Points out;
  for (int i = 0; i < count; ++i) out.push_back(random.in_cube(7) + glm::dvec3{0, 0, 7.3});
  return out;
}

struct Case {
  std::vector<Quad> walls;
  Points from, to;
};

Case random_case(Random& random) {
  Case out{random_scene(random), {}, {}};
  out.from = places(random, 2);
  out.to = places(random, 6);
  return out;
}

// A sheet of a plane that contains `eye`, a few metres away from it.
Quad seen_edge_on(Random& random, const glm::dvec3& eye) {
  const glm::dvec3 away = random.direction(), aside = random.direction();
  const glm::dvec3 corner = eye + random.between(2, 5) * away;
  return {corner, random.between(1, 3) * away + random.between(-0.5, 0.5) * aside, random.between(1, 3) * aside};
}

// Sheets whose planes contain an end, or its image in another sheet: only their edges are seen, and these as lines. The
// image is 5 nm above the plane of the last one, which is so small that the beam to it is too thin to follow.
Case edge_on_case(Random& random) {
  Case out{{}, places(random, 2), places(random, 6)};
  const Quad mirror{{-9, 9.1, -1}, {18, 0.7, 0}, {0, 0.3, 15}};
  const glm::dvec3 normal = glm::normalize(glm::cross(mirror.u, mirror.v));
  const glm::dvec3 image = out.from[1] - 2.0 * glm::dot(normal, out.from[1] - mirror.corner) * normal;
  out.walls = {mirror, seen_edge_on(random, out.from[0]), seen_edge_on(random, out.to[0])};
  for (const auto& [size, above] : {std::pair{2.0, 0.0}, {0.1, 5e-9}}) {
    const glm::dvec3 way = glm::normalize(glm::dvec3{random.between(-3, 3), 2, 6} - image), aside = random.direction();
    const glm::dvec3 from = image + above * glm::normalize(glm::cross(way, aside));
    out.walls.push_back({from + random.between(14, 18) * way, size * way, size * aside});
  }
  return out;
}

// Compares all paths of `count` scenes, and returns their number.
size_t compare(uint32_t count, const reference::Limits& limits, Case (*make)(Random&) = random_case) {
  size_t paths = 0;
  for (uint32_t seed = 1; seed <= count; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const auto [walls, from, to] = make(random);
    const SceneFile file(walls);
    Config config = config_of(file.path(), from, to, 1000, limits.max_depth);
    config.trace.discovery = "beams";
    config.trace.diffraction = limits.diffraction;
    config.trace.max_diffractions = limits.max_diffractions;
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

TEST_CASE("the same with two diffractions, order 3") {
  const uint32_t count = (scene_count() + 7) / 8;
  CHECK(compare(count, {.max_depth = 3, .diffraction = true, .max_diffractions = 2}) > 30 * count);
}

TEST_CASE("beams find the edges of sheets that they see edge-on, order 3") {
  const uint32_t count = (scene_count() + 1) / 2;
  CHECK(compare(count, {.max_depth = 3, .diffraction = true}, edge_on_case) > 30 * count);
}
