// SPDX-License-Identifier: Apache-2.0
// The brute-force oracle against closed forms: free space, ground, corridor, box, and the rules of blocking.
// Expected lengths come from image positions written out here, not from the oracle's own mirrors.
#include "reference/brute_force.hpp"
#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include "reference/quads.hpp"

using namespace wavetracer;
using namespace wavetracer::reference;
using glm::dvec3;

namespace {

std::vector<double> sorted_lengths(const PathGeometry& paths, const dvec3& tx, const dvec3& rx) {
  std::vector<double> lengths;
  for (size_t i = 0; i < paths.size(); ++i) lengths.push_back(path_length_m(paths, i, tx, rx));
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

void check_equal(const std::vector<double>& actual, std::vector<double> expected) {
  std::sort(expected.begin(), expected.end());
  REQUIRE(actual.size() == expected.size());
  for (size_t i = 0; i < actual.size(); ++i) CHECK(actual[i] == doctest::Approx(expected[i]).epsilon(1e-13));
}

// The image number k of coordinate x between walls at 0 and size: |k| reflections.
double image(double x, double size, int k) { return k % 2 == 0 ? k * size + x : (k + 1) * size - x; }

size_t order_of(const PathGeometry& paths, size_t i) { return paths.first[i + 1] - paths.first[i]; }

Quad ground(double half_size) { return {{-half_size, -half_size, 0}, {2 * half_size, 0, 0}, {0, 2 * half_size, 0}}; }

// A screen in the plane x = 0, y from -1 to 1, z from 0 to 2.
const Quad small_screen{{0, -1, 0}, {0, 2, 0}, {0, 0, 2}};

size_t count(const std::vector<Quad>& quads, const dvec3& tx, const dvec3& rx, uint32_t max_order) {
  return brute_force_paths(scene_of_quads(quads), {tx}, {rx}, max_order).size();
}

}  // namespace

TEST_CASE("an empty scene has the line of sight and nothing else") {
  const PathGeometry paths = brute_force_paths(Scene{}, {{0, 0, 0}, {0, 0, 1}}, {{3, 4, 0}}, 3);
  REQUIRE(paths.size() == 2);
  CHECK(paths.tx == std::vector<uint32_t>{0, 1});
  CHECK(paths.vertex.empty());
  CHECK(path_length_m(paths, 0, {0, 0, 0}, {3, 4, 0}) == doctest::Approx(5).epsilon(1e-15));
}

TEST_CASE("two-ray ground: one reflection where the heights divide the distance") {
  const dvec3 tx{0, 0, 6}, rx{40, 0, 2};
  const PathGeometry paths = brute_force_paths(scene_of_quads({ground(100)}), {tx}, {rx}, 3);
  REQUIRE(paths.size() == 2);
  CHECK(order_of(paths, 0) == 0);
  REQUIRE(order_of(paths, 1) == 1);
  CHECK(glm::distance(paths.vertex[0], dvec3(30, 0, 0)) < 1e-12);  // 40 * 6 / (6 + 2)
  CHECK(path_length_m(paths, 1, tx, rx) == doctest::Approx(std::hypot(40.0, 8.0)).epsilon(1e-14));
  CHECK(paths.interaction == std::vector<uint8_t>{1});
}

TEST_CASE("corridor: two paths an order, sorted by order") {
  const double width = 3;
  const Quad left{{-200, 0, -50}, {400, 0, 0}, {0, 0, 100}}, right{{-200, width, -50}, {400, 0, 0}, {0, 0, 100}};
  const dvec3 tx{0, 1.1, 0.2}, rx{20, 2.3, 0.7};
  const PathGeometry paths = brute_force_paths(scene_of_quads({left, right}), {tx}, {rx}, 3);
  std::vector<double> expected;
  for (int k = -3; k <= 3; ++k) expected.push_back(glm::distance(dvec3(tx.x, image(tx.y, width, k), tx.z), rx));
  check_equal(sorted_lengths(paths, tx, rx), expected);
  for (size_t i = 1; i < paths.size(); ++i) CHECK(order_of(paths, i) == (i + 1) / 2);
}

TEST_CASE("box: 4 n^2 + 2 paths of order n, each as long as its image is far") {
  const dvec3 size{5, 4, 3}, tx{1.1, 0.7, 1.3}, rx{3.9, 3.1, 0.9};
  const PathGeometry paths = brute_force_paths(scene_of_quads(box_walls({0, 0, 0}, size)), {tx}, {rx}, 3);
  std::vector<double> expected;
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j)
      for (int k = -3; k <= 3; ++k)
        if (std::abs(i) + std::abs(j) + std::abs(k) <= 3)
          expected.push_back(
              glm::distance(dvec3(image(tx.x, size.x, i), image(tx.y, size.y, j), image(tx.z, size.z, k)), rx));
  check_equal(sorted_lengths(paths, tx, rx), expected);
  for (size_t order = 0; order <= 3; ++order) {
    size_t found = 0;
    for (size_t i = 0; i < paths.size(); ++i) found += order_of(paths, i) == order;
    CHECK(found == (order == 0 ? 1 : 4 * order * order + 2));
  }
}

TEST_CASE("specular law: equal angles in one plane with the normal, at every vertex") {
  const dvec3 tx{1.1, 0.7, 1.3}, rx{3.9, 3.1, 0.9};
  const Scene scene = scene_of_quads(box_walls({0, 0, 0}, {5, 4, 3}));
  const PathGeometry paths = brute_force_paths(scene, {tx}, {rx}, 3);
  for (size_t i = 0; i < paths.size(); ++i)
    for (size_t k = paths.first[i]; k < paths.first[i + 1]; ++k) {
      const dvec3 before = k == paths.first[i] ? tx : paths.vertex[k - 1];
      const dvec3 after = k + 1 == paths.first[i + 1] ? rx : paths.vertex[k + 1];
      const dvec3 change = glm::normalize(after - paths.vertex[k]) - glm::normalize(paths.vertex[k] - before);
      CHECK(glm::length(glm::cross(change, scene.surfaces[paths.surface[k]].normal)) < 1e-13);
    }
}

TEST_CASE("a screen blocks what crosses it and nothing beside it") {
  CHECK(count({small_screen}, {-3, 0, 1}, {3, 0.1, 1.2}, 0) == 0);
  CHECK(count({small_screen}, {-3, 1.5, 1}, {3, 1.5, 1.2}, 0) == 1);
  CHECK(count({small_screen}, {-3, 0.2, 1}, {-1, 0.1, 1}, 0) == 1);  // wholly in front of it
  CHECK(count({small_screen}, {-3, 0.999, 1}, {3, 0.999, 1}, 0) == 0);
  CHECK(count({small_screen}, {-3, 1.001, 1}, {3, 1.001, 1}, 0) == 1);
  CHECK(count({small_screen}, {-3, 0.5, 0.5}, {3, 0.5, 0.5}, 0) == 0);  // through the diagonal of its triangles
}

TEST_CASE("a reflected leg is blocked as well") {
  CHECK(count({ground(100)}, {-3, 0, 1}, {3, 0, 0.5}, 1) == 2);
  CHECK(count({ground(100), small_screen}, {-3, 0, 1}, {3, 0, 0.5}, 1) ==
        0);  // the ground point is 1 m behind the screen
  // Ends above the screen see each other; the ground in the middle lies under it.
  const Quad low_screen{{-1, -1, 0.2}, {0, 2, 0}, {0, 0, 1}};
  CHECK(count({ground(100), low_screen}, {-3, 0, 2}, {3, 0, 2}, 1) == 1);
}

TEST_CASE("an end within 1e-4 m of a plane is not behind it") {
  CHECK(count({small_screen}, {-3, 0, 1}, {5e-5, 0, 1}, 0) == 1);
  CHECK(count({small_screen}, {-3, 0, 1}, {2e-4, 0, 1}, 0) == 0);
}

TEST_CASE("surfaces reflect on both faces, and never through themselves") {
  CHECK(count({ground(100)}, {0, 0, -1}, {5, 0, -2}, 3) == 2);
  CHECK(count({ground(100)}, {0, 0, 1}, {5, 0, -2}, 3) == 0);
}

TEST_CASE("a point outside the surface is no reflection") {
  const Quad small{{2, -0.5, 0}, {1, 0, 0}, {0, 1, 0}};  // x from 2 to 3
  CHECK(count({small}, {0, 0, 1}, {5, 0, 1}, 1) == 2);
  CHECK(count({small}, {0, 0, 1}, {3, 0, 1}, 1) == 1);
}

TEST_CASE("a point on the border of two coplanar surfaces is one path, of the first surface") {
  const Quad west{{-10, -10, 0}, {10, 0, 0}, {0, 20, 0}}, east{{0, -10, 0}, {10, 0, 0}, {0, 20, 0}};
  const PathGeometry paths = brute_force_paths(scene_of_quads({west, east}), {{-2, 0, 1}}, {{2, 0, 1}}, 3);
  REQUIRE(paths.size() == 2);
  CHECK(paths.surface == std::vector<uint32_t>{0});
  CHECK(glm::distance(paths.vertex[0], dvec3(0)) < 1e-15);
}

TEST_CASE("reciprocity: swapped ends give the reversed paths") {
  const Scene scene = scene_of_quads(
      {ground(20), small_screen, {{-5, 4, 0}, {10, 0, 0}, {0, 0, 6}}, {{-5, -3, 0}, {9, 1, 0}, {0, 0, 5}}});
  const dvec3 a{-3, 0.3, 1}, b{4, 0.8, 1.4};
  const PathGeometry there = brute_force_paths(scene, {a}, {b}, 3), back = brute_force_paths(scene, {b}, {a}, 3);
  CHECK(there.size() > 3);
  check_equal(sorted_lengths(there, a, b), sorted_lengths(back, b, a));
}
