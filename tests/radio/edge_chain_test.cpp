// SPDX-License-Identifier: Apache-2.0
// Rows of screens whose tops lie in one line with both ends, a little under it: of equal legs, N of them leave 1 / (N +
// 1) of the free-space field (L. Vogler, Radio Science 17(6), 1982).
#include "radio/fields.hpp"
#include "radio/world.hpp"

using namespace wavetracer;

namespace {

constexpr double leg_m = 50;

// Vertical screens of a conductor at x = 50, 100, ... m, which end at z = 0; both ends are under_m below that.
test::World row_of_screens(uint32_t count, double under_m) {
  test::World world(9e8);
  world.scene.origin_m = {0, 0, 0};
  std::vector<uint32_t> numbers;
  std::vector<glm::dvec3> points;
  for (uint32_t i = 0; i < count; ++i) {
    const double x = leg_m * (i + 1);
    const uint32_t screen = world.add_plane({-1, 0, 0}, {x, 0, 0}, test::conductor());
    world.scene.wedges.push_back({.start = {x, 500, 0},
                                  .along = {0, -1, 0},
                                  .length_m = 1000,
                                  .face = {0, 0, -1},
                                  .normal = {-1, 0, 0},
                                  .exterior_rad = 2 * std::numbers::pi,
                                  .surface = {screen, screen},
                                  .plane = {screen, screen}});
    numbers.push_back(i);
    points.emplace_back(x, 0, 0);
  }
  world.config.transmitters = {test::World::end({0, 0, -under_m}, "isotropic", "VH")};
  world.config.receivers = {test::World::end({leg_m * (count + 1), 0, -under_m}, "isotropic", "VH")};
  world.add_path(0, 0, numbers, std::vector<uint8_t>(count, diffraction), points);
  return world;
}

// The mean of V and H, whose reflections at the screens are of opposite signs.
double over_free_space(const test::World& world, uint32_t count) {
  const Paths paths = world.paths();
  REQUIRE(paths.size() == 1);
  const double free = world.wavelength_m() / (4 * std::numbers::pi * leg_m * (count + 1));
  return (std::abs(paths.a[0][0]) + std::abs(paths.a[0][3])) / 2 / free;
}

}  // namespace

TEST_CASE("N screens of one height, equally far apart, leave 1 / (N + 1) of the field") {
  for (uint32_t count = 1; count <= 8; ++count) {
    CAPTURE(count);
    CHECK(over_free_space(row_of_screens(count, 1e-6), count) == test::near(1.0 / (count + 1), 0.005));
  }
}

TEST_CASE("a chain of edges does not jump where its ends sink under the tops of the screens") {
  for (const uint32_t count : {2u, 3u, 5u}) {
    CAPTURE(count);
    double before = over_free_space(row_of_screens(count, 1e-6), count);
    for (double under_m = 0.01; under_m < 5; under_m += 0.01) {
      const double now = over_free_space(row_of_screens(count, under_m), count);
      CHECK(now < before);
      CHECK(before - now < 4e-3);
      before = now;
    }
  }
}

TEST_CASE("what runs along an edge to its end is not diffracted, and leaves numbers that are finite") {
  for (const uint32_t count : {1u, 2u, 3u}) {
    CAPTURE(count);
    test::World world = row_of_screens(count, 1);
    world.config.transmitters = {
        test::World::end({leg_m, -600, 0}, "isotropic", "VH")};  // on the line of the first edge
    const Paths paths = world.paths();
    REQUIRE(paths.size() == 1);
    for (const std::complex<double>& a : paths.a[0]) CHECK(std::abs(a) == 0);  // not NaN
  }
}
