// SPDX-License-Identifier: Apache-2.0
// Tests which antennas launch through a window, and that nothing of the scene or of its vehicles is beside it.
#include "simulation/launch_windows.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "wavetracer/device/directions.h"
#include "wavetracer/device/moving.h"

using namespace wavetracer;

namespace {

const LaunchBounds city{{-500, -400, 0}, {500, 400, 60}};

Scene scene_in(const LaunchBounds& box) {
  Scene out;
  out.lower = box.lower;
  out.upper = box.upper;
  out.surfaces.push_back({.lower = box.lower, .upper = box.upper});
  return out;
}

bool inside(const LaunchWindow& w, const glm::dvec3& to) {
  const glm::dvec3 d = glm::normalize(to);
  const double height = glm::dot(d, w.z), azimuth = std::atan2(glm::dot(d, w.y), glm::dot(d, w.x));
  return std::abs(azimuth) <= w.half_rad && height >= w.low && height <= w.high;
}

struct Parts {
  std::vector<Launcher> launchers;
  SlopeTables tables;
};

Parts parts_of(const Scene& scene, const WorldState& state, const std::vector<Scene>& models,
               const std::vector<Instance>& instances, const Launcher& from, bool followed = false) {
  Parts out;
  out.launchers = LaunchWindows(scene, models, instances, followed).of({from}, state, out.tables);
  return out;
}

WorldState vehicles_at(const std::vector<glm::dvec3>& places) {
  WorldState out;
  for (const glm::dvec3& p : places) {
    Placement body;
    body.present = true;
    body.position_m = p;
    out.instances.push_back(body);
  }
  return out;
}

Scene car() {
  Scene out = scene_in({{-2, -1, 0}, {2, 1, 1.5}});
  return out;
}

}  // namespace

TEST_CASE("every point of the box is in the window, from all sides and distances") {
  std::mt19937_64 random(5);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  int windows = 0, level = 0, outside = 0;
  for (int i = 0; i < 4000; ++i) {
    const double distance_m = 700 * std::exp2(uniform(0, 20)), h = uniform(-1, 1), a = uniform(0, 6.2831853);
    const double r = std::sqrt(1 - h * h);
    const glm::dvec3 p = distance_m * glm::dvec3(r * std::cos(a), r * std::sin(a), i % 3 == 0 ? 0.02 * h : h);
    const std::optional<LaunchWindow> w = window_to(city, p);
    if (!w) continue;
    ++windows;
    level += w->level;
    CHECK(std::abs(glm::dot(w->x, w->y)) + std::abs(glm::dot(w->x, w->z)) + std::abs(glm::dot(w->y, w->z)) < 1e-12);
    CHECK(glm::length(glm::cross(w->x, w->y) - w->z) < 1e-12);
    for (int k = 0; k < 200; ++k) {
      glm::dvec3 q(uniform(-500, 500), uniform(-400, 400), uniform(0, 60));
      if (k % 2) q[k / 2 % 3] = (k & 8 ? city.upper : city.lower)[k / 2 % 3];  // on a face
      outside += !inside(*w, q - p);
      CHECK(glm::length(q - p) > w->ahead_m);
    }
    // The window is not much larger than necessary: the solid angle of the sphere around the box.
    const double away_m = glm::length(p);
    if (away_m > 3000 && away_m < 1e6) CHECK(w->solid_angle() < 6 * std::pow(645 / (away_m - 645), 2));
  }
  CHECK(outside == 0);
  CHECK(windows > 3000);
  CHECK(level > 500);
}

TEST_CASE("antennas in the box, near it or around it have none") {
  for (const glm::dvec3& p : {glm::dvec3(0, 0, 1.5), {499, 399, 60}, {0, 0, 90}, {0, 0, 400}, {530, 0, 1.5}})
    CHECK_FALSE(window_to(city, p).has_value());
  for (const glm::dvec3& p : {glm::dvec3(0, 0, 2000), {0, 0, -5000}, {3000, 0, 1.5}, {0, 0, 5e5}, {3.6e7, 0, 3e6}})
    CHECK(window_to(city, p).has_value());
  CHECK_FALSE(window_to({}, {0, 0, 9}).has_value());
}

TEST_CASE("a window is one more table, and its launcher starts before the scene unless somebody follows its rays") {
  const WorldState nothing;
  const Launcher high{2, {0, 0, 20000}}, low{3, {0, 0, 2}};
  const Parts seen = parts_of(scene_in(city), nothing, {}, {}, high);
  REQUIRE(seen.launchers.size() == 1);
  CHECK(seen.launchers[0].window);
  CHECK(seen.launchers[0].transmitter == 2);
  CHECK(seen.launchers[0].position_m.z == doctest::Approx(20000 - 0.99 * 19940));
  CHECK(seen.tables.values.size() == 2 * size_t{height_table_size});
  const Parts followed = parts_of(scene_in(city), nothing, {}, {}, high, true);
  CHECK(followed.launchers[0].position_m == glm::dvec3(0, 0, 20000));
  CHECK(followed.tables.values[WT_WINDOW_AHEAD] == 0);
  const Parts street = parts_of(scene_in(city), nothing, {}, {}, low);
  CHECK_FALSE(street.launchers[0].window);
  CHECK(street.tables.values.empty());
}

TEST_CASE("a level window keeps the spread of the launch without it, between its heights") {
  SlopeTables tables;
  const HeightShare shares[] = {{1, 0.01, true}, {1, 0.01, false}};
  tables.values = height_table(shares, 0.25);
  tables.of_origin = {0};
  const LaunchBounds tall{{3000, -500, 0}, {4000, 500, 900}};
  const std::vector<Launcher> out =
      LaunchWindows(scene_in(tall), {}, {}, false).of({{0, {0, 0, 2}}}, WorldState{}, tables);
  REQUIRE(out.size() == 1);
  REQUIRE(out[0].window);
  const float* const table = tables.values.data() + size_t{out[0].heights} * height_table_size;
  CHECK(table[0] == doctest::Approx(0.29).epsilon(0.05));
  CHECK(table[WT_HEIGHT_CELLS] < 0);
  CHECK(table[WT_HEIGHT_CELLS] > -0.01);
  CHECK(table[WT_HEIGHT_CELLS / 2] < 0.03);  // half of the rays go to the streets, not to the tops of towers
}

TEST_CASE("vehicles: within the window of the scene, in a larger one, or in a launch of their own") {
  const std::vector<Scene> models{car()};
  const std::vector<Instance> instances(3, Instance{});
  const Launcher high{0, {0, 0, 20000}};
  const Scene scene = scene_in(city);
  CHECK(parts_of(scene, vehicles_at({{0, 0, 0}, {100, 50, 0}}), models, instances, high).launchers.size() == 1);
  CHECK(parts_of(scene, vehicles_at({{600, 0, 0}}), models, instances, high).launchers.size() == 1);
  const Parts far = parts_of(scene, vehicles_at({{9000, 0, 0}}), models, instances, high);
  REQUIRE(far.launchers.size() == 2);
  CHECK(far.launchers[0].window);
  CHECK(far.launchers[1].window);
  CHECK(far.launchers[0].heights != far.launchers[1].heights);
  // One vehicle flies beside the antenna, so the rays for vehicles are launched in all directions.
  const Parts beside = parts_of(scene, vehicles_at({{10, 0, 20000}, {0, 0, 0}}), models, instances, high);
  REQUIRE(beside.launchers.size() == 2);
  CHECK(beside.launchers[0].window);
  CHECK_FALSE(beside.launchers[1].window);
  // The vehicle that carries the antenna is not seen; with followed rays there is one launch.
  Launcher own = high;
  own.source = WT_OWN | 0;
  CHECK(parts_of(scene, vehicles_at({{10, 0, 20000}, {0, 0, 0}}), models, instances, own).launchers.size() == 1);
  const Parts followed = parts_of(scene, vehicles_at({{9000, 0, 0}}), models, instances, high, true);
  REQUIRE(followed.launchers.size() == 1);
  CHECK_FALSE(followed.launchers[0].window);
  // Without a static scene there are the vehicles alone.
  const Parts alone = parts_of(Scene{}, vehicles_at({{0, 0, 0}, {30, 0, 0}}), models, instances, high);
  REQUIRE(alone.launchers.size() == 1);
  CHECK(alone.launchers[0].window);
}
