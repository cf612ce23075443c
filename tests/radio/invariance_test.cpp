// SPDX-License-Identifier: Apache-2.0
// Changes that must not change a result: swapping the ends, turning the world, the order of discovery, the number of
// threads. The world: four walls of different materials and directions, two polarised ends, paths up to order 3.
#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "radio/antenna.hpp"
#include "radio/fields.hpp"
#include "radio/world.hpp"

using namespace wavetracer;
using test::World;

namespace {

struct Ends {
  RadioEnd tx, rx;
};

Ends some_ends() {
  return {World::end({0.3, -0.2, 0.1}, "tr38901", "cross", {35, 10, -20}),
          World::end({2.1, 1.4, -0.6}, "dipole", "VH", {-70, 25, 40})};
}

// The sequences of the test: all of distinct neighbours up to order 3.
World walled(const Ends& ends, const glm::dmat3& turn = glm::dmat3(1.0)) {
  World world;
  const Material metal{"metal", 1, 0, 1e7, 0, 1, 100, 0.1};
  world.add_plane(turn * glm::dvec3{0, 0.1, 1}, turn * glm::dvec3{0, 0, -3}, test::medium_dry_ground());
  world.add_plane(turn * glm::dvec3{1, 0.2, 0}, turn * glm::dvec3{5, 0, 0}, test::concrete(0.1));
  world.add_plane(turn * glm::dvec3{0, 1, -0.3}, turn * glm::dvec3{0, 6, 0}, metal);
  world.add_plane(turn * glm::dvec3{1, 1, 1}, turn * glm::dvec3{-4, -4, 0}, test::concrete(0.02));
  world.config.transmitters = {ends.tx};
  world.config.receivers = {ends.rx};
  world.add_reflections(0, 0, {});
  for (uint32_t i = 0; i < 4; ++i) {
    world.add_reflections(0, 0, {i});
    for (uint32_t j = 0; j < 4; ++j) {
      if (j == i) continue;
      world.add_reflections(0, 0, {i, j});
      for (uint32_t k = 0; k < 4; ++k) {
        if (k != j) world.add_reflections(0, 0, {i, j, k});
      }
    }
  }
  return world;
}

// The end after its world was turned: place and orientation.
RadioEnd turned(RadioEnd end, const glm::dmat3& turn) {
  const glm::dvec3 p = turn * glm::dvec3{end.position_m[0], end.position_m[1], end.position_m[2]};
  end.position_m = {p.x, p.y, p.z};
  const glm::dmat3 r = turn * rotation_of(end.orientation_deg);  // r[column][row]
  constexpr double degrees = 180 / std::numbers::pi;
  end.orientation_deg = {std::atan2(r[0][1], r[0][0]) * degrees, -std::asin(r[0][2]) * degrees,
                         std::atan2(r[1][2], r[2][2]) * degrees};
  return end;
}

double largest(const Paths& paths, size_t row) {
  double most = 0;
  for (const auto& a : paths.a[row]) most = std::max(most, std::abs(a));
  return most;
}

}  // namespace

TEST_CASE("reciprocity: swapping the ends transposes the matrix and swaps the angles") {
  const Ends ends = some_ends();
  const Paths there = walled(ends).paths();
  World back = walled({ends.rx, ends.tx});
  const Paths again = back.paths();
  REQUIRE(there.size() == 1 + 4 + 12 + 36);
  REQUIRE(again.size() == there.size());
  for (size_t i = 0; i < there.size(); ++i) {
    // The reverse path has the same length up to rounding, hence nearly the same row.
    std::vector<uint32_t> surfaces(
        there.vertex_surface.begin() + static_cast<std::ptrdiff_t>(there.vertex_offset[i]),
        there.vertex_surface.begin() + static_cast<std::ptrdiff_t>(there.vertex_offset[i + 1]));
    std::reverse(surfaces.begin(), surfaces.end());
    size_t j = 0;
    const auto same = [&](size_t row) {
      return std::equal(surfaces.begin(), surfaces.end(),
                        again.vertex_surface.begin() + static_cast<std::ptrdiff_t>(again.vertex_offset[row]),
                        again.vertex_surface.begin() + static_cast<std::ptrdiff_t>(again.vertex_offset[row + 1]));
    };
    while (j < again.size() && !same(j)) ++j;
    REQUIRE(j < again.size());
    const double scale = largest(there, i);
    CHECK(std::abs(there.a[i][0] - again.a[j][0]) < 1e-11 * scale);
    CHECK(std::abs(there.a[i][1] - again.a[j][2]) < 1e-11 * scale);
    CHECK(std::abs(there.a[i][2] - again.a[j][1]) < 1e-11 * scale);
    CHECK(std::abs(there.a[i][3] - again.a[j][3]) < 1e-11 * scale);
    CHECK(there.aod_theta_rad[i] == test::near(again.aoa_theta_rad[j], 1e-12));
    CHECK(there.aoa_phi_rad[i] == test::near(again.aod_phi_rad[j], 1e-12));
  }
}

TEST_CASE("turning the whole world leaves every port coefficient and delay as it was") {
  const Ends ends = some_ends();
  const Paths before = walled(ends).paths();
  for (const std::array<double, 3>& angles : {std::array{90.0, 0.0, 0.0}, {25.0, -40.0, 70.0}, {180.0, 80.0, 3.0}}) {
    const glm::dmat3 turn = rotation_of(angles);
    const Paths after = walled({turned(ends.tx, turn), turned(ends.rx, turn)}, turn).paths();
    REQUIRE(after.size() == before.size());
    for (size_t i = 0; i < before.size(); ++i) {
      CHECK(after.delay_s[i] == test::near(before.delay_s[i], 1e-13));
      CHECK(after.gain_db[i] == test::near(before.gain_db[i], 1e-10));
      for (size_t p = 0; p < 4; ++p) CHECK(std::abs(after.a[i][p] - before.a[i][p]) < 1e-10 * largest(before, i));
    }
  }
}

TEST_CASE("the order of discovery and the number of threads change no bit") {
  World world = walled(some_ends());
  PathGeometry all;
  const auto append = [&](size_t row) {
    const PathGeometry& g = world.geometry;
    all.tx.push_back(g.tx[row]);
    all.rx.push_back(g.rx[row]);
    for (uint64_t i = g.first[row]; i < g.first[row + 1]; ++i) {
      all.surface.push_back(g.surface[i]);
      all.interaction.push_back(g.interaction[i]);
      all.vertex.push_back(g.vertex[i]);
    }
    all.first.push_back(all.surface.size());
  };
  std::vector<size_t> order(world.geometry.size() * 40);
  for (size_t i = 0; i < order.size(); ++i) order[i] = i % world.geometry.size();

  std::vector<Paths> results;
  std::mt19937 random(5);
  for (const size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::shuffle(order.begin(), order.end(), random);
    all = PathGeometry{};
    for (const size_t row : order) append(row);
    results.push_back(compute_paths(world.scene, world.config, 0, all));
  }
  for (size_t k = 1; k < results.size(); ++k) {
    CHECK(results[k].delay_s == results[0].delay_s);
    CHECK(results[k].gain_db == results[0].gain_db);
    CHECK(results[k].a == results[0].a);
    CHECK(results[k].aoa_phi_rad == results[0].aoa_phi_rad);
    CHECK(results[k].vertex_surface == results[0].vertex_surface);
    CHECK(results[k].vertex_position_m == results[0].vertex_position_m);
  }
  CHECK(std::is_sorted(results[0].delay_s.begin(), results[0].delay_s.end()));
}

TEST_CASE("rows of many links: the order of discovery and the number of threads change no bit, and rows are sorted") {
  const Ends ends = some_ends();
  World world = walled(ends);
  world.geometry = {};
  world.config.transmitters.edit().assign(7, ends.tx);
  world.config.receivers.edit().assign(9, ends.rx);
  struct Case {
    uint32_t tx, rx;
    std::vector<uint32_t> surfaces;
  };
  std::vector<Case> cases;
  for (uint32_t tx = 0; tx < 7; ++tx)
    for (uint32_t rx = 0; rx < 9; ++rx)
      for (const std::vector<uint32_t>& surfaces : std::vector<std::vector<uint32_t>>{{}, {2}, {0, 3}, {1, 2, 0}})
        if ((tx + rx) % 4 != 0) cases.push_back({tx, rx, surfaces});
  for (size_t i = 0; i < 7; ++i) world.config.transmitters[i].position_m[0] += 0.1 * static_cast<double>(i);
  for (size_t i = 0; i < 9; ++i) world.config.receivers[i].position_m[1] -= 0.1 * static_cast<double>(i);

  std::vector<Paths> results;
  std::mt19937 random(3);
  for (const size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::ranges::shuffle(cases, random);
    world.geometry = {};
    for (const Case& c : cases) world.add_reflections(c.tx, c.rx, c.surfaces);
    results.push_back(world.paths());
  }
  const Paths& first = results[0];
  for (size_t i = 1; i < first.size(); ++i)
    CHECK(std::tuple(first.tx[i - 1], first.rx[i - 1], first.delay_s[i - 1]) <
          std::tuple(first.tx[i], first.rx[i], first.delay_s[i]));
  for (const Paths& other : results) {
    REQUIRE(other.size() == cases.size());
    CHECK(other.tx == first.tx);
    CHECK(other.rx == first.rx);
    CHECK(other.a == first.a);
    CHECK(other.depth == first.depth);
    CHECK(other.vertex_offset == first.vertex_offset);
    CHECK(other.vertex_position_m == first.vertex_position_m);
    CHECK(other.vertex_surface == first.vertex_surface);
  }
}
