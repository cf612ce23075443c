// SPDX-License-Identifier: Apache-2.0
// Two oracles against each other: brute force on the copied scenes finds the paths of the reference lists.
// For specular lists only the orders that brute force reaches are compared; up to there those lists are complete.
#include <doctest/doctest.h>
#include <tuple>
#include "folders.hpp"
#include "reference/brute_force.hpp"
#include "reference/compare.hpp"
#include "scene/load.hpp"

using namespace wavetracer;
using namespace wavetracer::reference;

namespace {

const std::filesystem::path reference_folder = std::filesystem::path(test::source_folder()) / "tests" / "reference";

Scene load(const Case& reference) {
  return load_scene_file(reference_folder / "scenes" / reference.scene / (reference.scene + ".xml"), {}, {});
}

std::vector<glm::dvec3> recentred(std::vector<glm::dvec3> points, const Scene& scene) {
  for (glm::dvec3& point : points) point -= scene.origin_m;
  return points;
}

// Delays and vertices only: the oracle knows no fields.
Paths geometry_only(const PathGeometry& geometry, const Case& reference, const Scene& scene) {
  constexpr double speed_of_light_m_s = 299792458.0;
  const auto tx = recentred(reference.transmitters_m, scene), rx = recentred(reference.receivers_m, scene);
  Paths paths;
  paths.tx = geometry.tx;
  paths.rx = geometry.rx;
  paths.vertex_offset = geometry.first;
  paths.vertex_interaction = geometry.interaction;
  for (const glm::dvec3& vertex : geometry.vertex) paths.vertex_position_m.push_back(vertex + scene.origin_m);
  for (size_t i = 0; i < geometry.size(); ++i)
    paths.delay_s.push_back(path_length_m(geometry, i, tx[geometry.tx[i]], rx[geometry.rx[i]]) / speed_of_light_m_s);
  paths.a.resize(geometry.size());
  return paths;
}

// Paths of all interactions that the list has. Lists have no free edges.
Comparison compare_all(const Case& reference, const Scene& scene, uint32_t max_depth) {
  const Limits limits{.max_depth = max_depth,
                      .reflection = reference.reflection,
                      .transmission = reference.transmission,
                      .max_transmissions = max_depth,
                      .diffraction = reference.diffraction,
                      .free_edges = false};
  const PathGeometry geometry = brute_force_all(scene, recentred(reference.transmitters_m, scene),
                                                recentred(reference.receivers_m, scene), limits);
  return compare_paths(reference, geometry_only(geometry, reference, scene));
}

// Returns how many paths the list has with at most max_order interactions, which are all reflections.
size_t specular_count(const Paths& paths, uint32_t max_order) {
  size_t count = 0;
  for (size_t i = 0; i < paths.size(); ++i) {
    bool counts = paths.depth[i] <= max_order;
    for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k)
      counts &= paths.vertex_interaction[k] == reflection;
    count += counts;
  }
  return count;
}

struct Outcome {
  Comparison comparison;
  size_t expected;
};

Outcome compare(const char* name, uint32_t max_order) {
  const Case reference = load_case(reference_folder / "oracle" / (std::string(name) + ".json"));
  const Scene scene = load(reference);
  const PathGeometry geometry = brute_force_paths(scene, recentred(reference.transmitters_m, scene),
                                                  recentred(reference.receivers_m, scene), max_order);
  return {compare_paths(reference, geometry_only(geometry, reference, scene)),
          specular_count(reference.paths, max_order)};
}

}  // namespace

TEST_CASE("one, two and three reflectors: the same paths") {
  const std::pair<const char*, size_t> cases[] = {
      {"simple_reflector", 2}, {"double_reflector", 4}, {"triple_reflector", 7}};
  for (const auto& [name, paths] : cases) {
    CAPTURE(name);
    const auto [result, expected] = compare(name, 3);
    CAPTURE(to_string(result));
    CHECK(expected == paths);
    CHECK(result.found == paths);
    CHECK(result.extra == 0);
    CHECK(result.duplicates == 0);
    CHECK(result.delay_rel_err_max < 1e-6);  // the list is float32
  }
}

TEST_CASE("box: 63 paths per receiver up to order 3, all of them in the list") {
  const auto [result, expected] = compare("box_depth5", 3);
  CAPTURE(to_string(result));
  CHECK(result.mine == 2 * 63);
  CHECK(expected == 2 * 63);
  CHECK(result.found == 2 * 63);
  CHECK(result.delay_rel_err_max < 1e-6);
}

TEST_CASE("box with a screen: what is reflected and not transmitted") {
  const auto [result, expected] = compare("box_one_screen", 3);
  CAPTURE(to_string(result));
  CHECK(result.found == expected);
  CHECK(result.extra == 0);
}

TEST_CASE("street canyon with cars, order 3: every path of the list") {
  const auto [result, expected] = compare("street_canyon_cars_specular", 3);
  CAPTURE(to_string(result));
  CHECK(expected == 90);
  CHECK(result.found == expected);
  CHECK(result.extra == 0);
  CHECK(result.duplicates == 0);
}

TEST_CASE("a wedge, a floor with a wall, a box with a screen: diffracted and transmitted paths") {
  const std::tuple<const char*, const char*, size_t> cases[] = {
      {"simple_wedge", "diffraction", 3}, {"floor_wall", "transmission", 1}, {"box_one_screen", "transmission", 19}};
  for (const auto& [name, kind, paths] : cases) {
    CAPTURE(name);
    const Case reference = load_case(reference_folder / "oracle" / (std::string(name) + ".json"));
    const Comparison result = compare_all(reference, load(reference), reference.max_depth);
    CAPTURE(to_string(result));
    CHECK(result.found == result.reference);
    CHECK(result.extra == 0);
    CHECK(result.duplicates == 0);
    CHECK(result.delay_rel_err_max < 1e-6);
    CHECK(result.kinds.at(kind).found == paths);
  }
}

TEST_CASE("street canyon with cars, two interactions: every path of the list") {
  const Case reference = load_case(reference_folder / "oracle" / "street_canyon_cars_all.json");
  const Comparison result = compare_all(reference, load(reference), 2);
  CAPTURE(to_string(result));
  size_t deeper = 0;
  for (const uint32_t depth : reference.paths.depth) deeper += depth > 2;
  CHECK(result.reference - deeper == 142);
  CHECK(result.found == 142);
  for (const size_t j : result.missing) {
    CAPTURE(to_string(reference.paths, j));
    CHECK(reference.paths.depth[j] > 2);
  }
  CHECK(result.duplicates == 0);
  CHECK(result.delay_rel_err_max < 1e-6);
}
