// SPDX-License-Identifier: Apache-2.0
// Tests the distance between neighbouring rays against rays that are generated and counted.
#include "simulation/launch_spacing.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "passes/launch_heights.hpp"
#include "simulation/launch_windows.hpp"
#include "wavetracer/device/directions.h"

using namespace wavetracer;

namespace {

constexpr double sphere_sr = 4 * std::numbers::pi;

glm::dvec3 direction_of(double elevation, double azimuth) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

// The share of 10^6 rays within a small angle of a direction, by the solid angle of that cone, in 1/sr. ray: the
// direction of a place of the cylinder.
template <class Ray>
double counted_density(const glm::dvec3& d, double angle_rad, const Ray& ray) {
  constexpr uint32_t rows = 1000;
  uint32_t within = 0;
  for (uint32_t i = 0; i < rows; ++i)
    for (uint32_t k = 0; k < rows; ++k) {
      const auto place = [](double part) { return static_cast<uint32_t>(4294967296.0 * part); };
      within += glm::length(ray(place((i + 0.5) / rows), place((k + 0.5) / rows)) - d) <= 2 * std::sin(angle_rad / 2);
    }
  return within / (double{rows} * rows) / (sphere_sr / 2 * (1 - std::cos(angle_rad)));
}

glm::dvec3 vector_of(const device::wt_direction& d) { return {d.x, d.y, d.z}; }

}  // namespace

TEST_CASE("the rays of an even launch share the sphere around the antenna") {
  const Launcher from{.transmitter = 0, .position_m = {1, 2, 3}};
  CHECK(spread_m2(from, {}, false, {1, 2, 13}) == doctest::Approx(sphere_sr * 100));
  CHECK(spread_m2(from, {}, false, {1, 2, 3}) == 0);
  const std::vector<float> even = height_table({}, 1);
  for (const glm::dvec3& at : {glm::dvec3(1, 2, 13), {11, 2, 3}, {-5, 4, -4.5}, {1, 2, -7}}) {
    const double apart_m = glm::length(at - from.position_m);
    CHECK(spread_m2(from, even, true, at) == doctest::Approx(sphere_sr * apart_m * apart_m).epsilon(1e-3));
  }
}

TEST_CASE("towards the horizon the rays of \"horizon\" are as dense as a count of them says") {
  const std::array<HeightShare, 2> shares{HeightShare{2, 0.02, true}, HeightShare{1, 0.1, false}};
  std::vector<float> tables = height_table({}, 1);
  const std::vector<float> horizon = height_table(shares, 0.25);
  tables.insert(tables.end(), horizon.begin(), horizon.end());
  const Launcher from{.transmitter = 0, .position_m = {0, 0, 10}, .heights = 1};
  for (const double elevation : {0.012, -0.012, 0.06, -0.06, -0.5, 1.2}) {
    CAPTURE(elevation);
    const glm::dvec3 d = direction_of(elevation, 0.7);
    const double counted =
        counted_density(d, std::min(std::abs(elevation) / 3, 0.02), [&](uint32_t height, uint32_t turn) {
          return vector_of(device::wt_cylinder_to_heights(height, turn, tables.data(), height_table_size));
        });
    CHECK(3000.0 * 3000.0 / spread_m2(from, tables, true, from.position_m + 3000.0 * d) ==
          doctest::Approx(counted).epsilon(0.15));
  }
}

TEST_CASE("through a window rays are denser, and beside it there are none") {
  Scene scene;
  scene.lower = {-500, -400, 0};
  scene.upper = {500, 400, 60};
  scene.surfaces.push_back({.lower = scene.lower, .upper = scene.upper});
  for (const glm::dvec3& p : {glm::dvec3(40, 30, 20000), {9000, -4000, 6000}, {30000, 2000, 40}}) {
    CAPTURE(p.z);
    SlopeTables tables;
    const std::vector<Launcher> through = LaunchWindows(scene, {}, {}, false).of({{0, p}}, {}, tables);
    REQUIRE(through.size() == 1);
    REQUIRE(through[0].window);
    const auto place = through[0].heights * height_table_size;
    for (const glm::dvec3& at : {glm::dvec3(0, 0, 20), {300, -200, 15}}) {
      const double apart_m = glm::length(at - p);
      const glm::dvec3 d = (at - p) / apart_m;
      const double angle_rad = 12 / apart_m;
      const double counted = counted_density(d, angle_rad, [&](uint32_t height, uint32_t turn) {
        return vector_of(device::wt_through_window(height, turn, tables.values.data(), place).along);
      });
      CHECK(apart_m * apart_m / spread_m2(through[0], tables.values, false, at) ==
            doctest::Approx(counted).epsilon(0.15));
    }
    CHECK(std::isinf(spread_m2(through[0], tables.values, false, p + (p - glm::dvec3(0, 0, 0)))));
    CHECK(std::isinf(spread_m2(through[0], tables.values, false, {20000, 20000, 0})));
  }
}

TEST_CASE("the farthest link counts, and of the launchers of a transmitter the densest") {
  const std::vector<EndState> receivers{{.position_m = {10, 0, 0}}, {.position_m = {100, 0, 0}}};
  const std::vector<Launcher> launchers{{.transmitter = 1, .position_m = {0, 0, 0}},
                                        {.transmitter = 1, .position_m = {40, 0, 0}},
                                        {.transmitter = 3, .position_m = {90, 0, 0}}};
  const auto widest = [&](const std::vector<Link>& links) {
    return widest_spread_m2(launchers, {}, false, links, receivers);
  };
  CHECK(widest({}) == 0);
  CHECK(widest({{1, 0}}) == doctest::Approx(sphere_sr * 100));
  CHECK(widest({{1, 0}, {1, 1}}) == doctest::Approx(sphere_sr * 3600));
  CHECK(widest({{1, 1}, {3, 0}}) == doctest::Approx(sphere_sr * 6400));
  CHECK(widest({{2, 1}, {3, 1}}) == doctest::Approx(sphere_sr * 100));  // nothing is sent by transmitter 2
}
