// SPDX-License-Identifier: Apache-2.0
// Transmitted paths of the brute-force oracle: the surfaces that a leg passes, their places, their order, and their
// largest number.
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include "reference/brute_force.hpp"
#include "reference/quads.hpp"
#include "wavetracer/paths.hpp"

using namespace wavetracer;
using namespace wavetracer::reference;
using glm::dvec3;

namespace {

// Screens in planes x = const, y from -10 to 10, z from -10 to 10.
Quad screen_at(double x) { return {{x, -10, -10}, {0, 20, 0}, {0, 0, 20}}; }

PathGeometry paths_through(const std::vector<Quad>& quads, const dvec3& tx, const dvec3& rx, Limits limits) {
  limits.transmission = true;
  return brute_force_all(scene_of_quads(quads), {tx}, {rx}, limits);
}

}  // namespace

TEST_CASE("one screen: the straight path, with a vertex where it passes") {
  const dvec3 tx{-2, 1, 0}, rx{6, 5, 4};
  const PathGeometry paths = paths_through({screen_at(0)}, tx, rx, {.max_depth = 1});
  REQUIRE(paths.size() == 1);  // a reflection needs both ends on one side
  CHECK(paths.interaction == std::vector<uint8_t>{transmission});
  CHECK(paths.surface == std::vector<uint32_t>{0});
  CHECK(glm::distance(paths.vertex[0], dvec3(0, 2, 1)) < 1e-14);
  CHECK(path_length_m(paths, 0, tx, rx) == doctest::Approx(glm::distance(tx, rx)).epsilon(1e-15));
}

TEST_CASE("screens are listed in the order in which they are passed, up to both limits") {
  const std::vector<Quad> quads{screen_at(3), screen_at(1), screen_at(2)};
  const dvec3 tx{0, 0.1, 0.2}, rx{4, 0.3, 0.1};
  const auto count = [&](uint32_t depth, uint32_t transmissions) {
    return paths_through(quads, tx, rx, {.max_depth = depth, .reflection = false, .max_transmissions = transmissions})
        .size();
  };
  CHECK(count(3, 3) == 1);
  CHECK(count(3, 2) == 0);
  CHECK(count(2, 3) == 0);
  const PathGeometry there =
      paths_through(quads, tx, rx, {.max_depth = 3, .reflection = false, .max_transmissions = 3});
  CHECK(there.surface == std::vector<uint32_t>{1, 2, 0});
  const PathGeometry back = paths_through(quads, rx, tx, {.max_depth = 3, .reflection = false, .max_transmissions = 3});
  CHECK(back.surface == std::vector<uint32_t>{0, 2, 1});
}

TEST_CASE("through a box two walls are passed; an end inside of it passes one") {
  const std::vector<Quad> box = box_walls({-1, -2, -3}, {1, 2, 3});
  const Limits straight{.max_depth = 5, .reflection = false};
  const PathGeometry through = paths_through(box, {-5, 0.3, 0.2}, {4, 1.1, -0.53}, straight);
  REQUIRE(through.size() == 1);
  CHECK(through.surface == std::vector<uint32_t>{0, 1});
  CHECK(through.vertex[0].x == -1);
  CHECK(through.vertex[1].x == 1);
  CHECK(paths_through(box, {-5, 0.3, 0.2}, {0, 1, -0.5}, straight).surface == std::vector<uint32_t>{0});
  CHECK(paths_through(box, {0, 4.5, 0.2}, {0.5, 1, -0.5}, straight).surface == std::vector<uint32_t>{3});
  CHECK(paths_through(box, {-5, 0.3, 0.2}, {4, 1.1, -0.53}, {.max_depth = 5, .max_transmissions = 1}).size() == 0);
}

TEST_CASE("reflected and transmitted: a wall seen through a screen") {
  // Between two screens at x = 0 and x = 10, receiver beyond the first: the second reflects, the first is passed after
  // it; reflections between both lengthen this by two each, and the depth of 4 lets one such pair be.
  const dvec3 tx{4, 0.3, 0.1}, rx{-3, -0.2, 0.4};
  const PathGeometry paths = paths_through({screen_at(0), screen_at(10)}, tx, rx, {.max_depth = 4});
  std::vector<double> expected;
  for (const double x : {4.0, 16.0, 24.0, 36.0})  // itself; by 10; by 0, then 10; by 10, 0, 10
    expected.push_back(glm::distance(dvec3(x, tx.y, tx.z), rx));
  REQUIRE(paths.size() == 4);
  for (size_t i = 0; i < 4; ++i) {
    CHECK(path_length_m(paths, i, tx, rx) == doctest::Approx(expected[i]).epsilon(1e-14));
    CHECK(paths.interaction[paths.first[i + 1] - 1] == transmission);
    CHECK(paths.surface[paths.first[i + 1] - 1] == 0);
    CHECK(paths.first[i + 1] - paths.first[i] == i + 1);
  }
}

TEST_CASE("walls that lie on one another are passed once, as the first of them; walls 1 mm apart twice") {
  const dvec3 tx{-2, 0.1, 0.2}, rx{2, 0.3, 0.1};
  const Limits straight{.max_depth = 3, .reflection = false};
  CHECK(paths_through({screen_at(0), screen_at(0)}, tx, rx, straight).surface == std::vector<uint32_t>{0});
  CHECK(paths_through({screen_at(2e-5), screen_at(0)}, tx, rx, straight).surface == std::vector<uint32_t>{0});
  CHECK(paths_through({screen_at(0), screen_at(1e-3)}, tx, rx, straight).surface == std::vector<uint32_t>{0, 1});
  // Side by side, passed on the border between them.
  const Quad left{{0, -10, -10}, {0, 10, 0}, {0, 0, 20}}, right{{0, 0, -10}, {0, 10, 0}, {0, 0, 20}};
  CHECK(paths_through({left, right}, {-2, 0, 0.2}, {2, 0, 0.1}, straight).surface == std::vector<uint32_t>{0});
}
