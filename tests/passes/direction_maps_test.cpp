// SPDX-License-Identifier: Apache-2.0
// The direction maps of wavetracer/device/direction_maps.h: inverse, equal-area, complete, and the same on the device.
// Round trips use directions at the edges of the maps: poles, axes, signed zeros, denormals, NaN.
#include "wavetracer/device/direction_maps.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using device::wt_direction;

namespace {

struct Cylinder {
  uint32_t height, turn;
};

Cylinder cylinder(const wt_direction& d) {
  Cylinder c{};
  device::wt_sphere_to_cylinder(d, &c.height, &c.turn);
  return c;
}

std::pair<uint32_t, uint32_t> octahedral_cell(const wt_direction& d, unsigned level) {
  uint32_t x, y;
  device::wt_octahedron_encode(d, level, &x, &y);
  return {x, y};
}

wt_direction random_direction(Random& random) {
  const glm::dvec3 d = random.direction();
  return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}

double length(const wt_direction& d) { return std::hypot(double{d.x}, double{d.y}, double{d.z}); }

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float tiny = std::numeric_limits<float>::min();

// Directions at which maps may fail: axes and poles with both zeros, planes between octants, just beside them, and
// invalid directions.
std::vector<wt_direction> hard_directions() {
  std::vector<wt_direction> out;
  for (const float x : {-1.0f, -0.70710678f, -tiny, -0.0f, 0.0f, tiny, 0.70710678f, 1.0f, not_a_number})
    for (const float y : {-1.0f, -0.70710678f, -tiny, -0.0f, 0.0f, tiny, 0.70710678f, 1.0f, not_a_number})
      for (const float z : {-1.0f, -0.70710678f, -tiny, -0.0f, 0.0f, tiny, 0.70710678f, 1.0f, not_a_number})
        out.push_back({x, y, z});
  return out;
}

}  // namespace

TEST_CASE("cylinder: turns within 1e-6 of the library's arctangent, heights within the rounding of z") {
  Random random(3);
  double worst_turn = 0, worst_height = 0;
  for (int i = 0; i < 200000; ++i) {
    const wt_direction d = random_direction(random);
    const Cylinder c = cylinder(d);
    const double turn = std::atan2(double{d.y}, double{d.x}) / (2 * std::numbers::pi);
    worst_turn = std::max(worst_turn, std::abs(std::remainder(c.turn * 0x1p-32 - turn, 1.0)));
    worst_height = std::max(worst_height, std::abs(c.height * 0x1p-32 - (1 - double{d.z}) / 2));
  }
  CHECK(worst_turn < 1e-7);
  CHECK(worst_height < 0x1p-24);
}

TEST_CASE("cylinder: there and back") {
  for (uint64_t i = 0; i < 100000; ++i) {
    // Away from the poles' last 2^-12, where a circle of latitude is too short to keep a turn.
    const auto height = static_cast<uint32_t>((i * 0x9E3779B97F4A7C15ul >> 32) % 0xFFE00000u + 0x100000u);
    const auto turn = static_cast<uint32_t>(i * 0xD1B54A32D192ED03ul >> 32);
    const Cylinder c = cylinder(device::wt_cylinder_to_sphere(height, turn));
    const double turns = std::remainder(c.turn * 0x1p-32 - turn * 0x1p-32, 1.0);
    if (std::abs(turns) > 2e-7 || std::abs(c.height * 0x1p-32 - height * 0x1p-32) > 0x1p-22) {
      CAPTURE(height);
      CAPTURE(turn);
      FAIL_CHECK("height " << c.height << ", turn " << c.turn);
    }
  }
}

TEST_CASE("cylinder: axes are exact, whatever the sign of their zeros, and poles have turn 0") {
  for (const float zero : {0.0f, -0.0f}) {
    CHECK(cylinder({1, zero, zero}).turn == 0);
    CHECK(cylinder({zero, 1, zero}).turn == 0x40000000u);
    CHECK(cylinder({-1, zero, zero}).turn == 0x80000000u);
    CHECK(cylinder({zero, -1, zero}).turn == 0xC0000000u);
    CHECK(cylinder({0.5f, zero, zero}).height == 0x80000000u);
    for (const float other : {0.0f, -0.0f}) {
      CHECK(cylinder({zero, other, 1}).height == 0);
      CHECK(cylinder({zero, other, -1}).height > 0xFFFFFEFFu);
      CHECK(cylinder({zero, other, 1}).turn == 0);
      CHECK(cylinder({zero, other, -1}).turn == 0);
    }
  }
}

TEST_CASE("cylinder: equal areas: every cell of 32 x 64 gets its share of evenly spread directions") {
  // A Fibonacci lattice, made here in double: 1,000 points a cell, whose counts differ by its discrepancy only.
  std::vector<int> counts(32 * 64, 0);
  constexpr int n = 1000 * 32 * 64;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n, radius = std::sqrt(1 - z * z);
    const double azimuth = 2 * std::numbers::pi * std::fmod(i * std::numbers::phi, 1.0);
    const Cylinder c = cylinder({static_cast<float>(radius * std::cos(azimuth)),
                                 static_cast<float>(radius * std::sin(azimuth)), static_cast<float>(z)});
    ++counts[(c.height >> 27) * 64 + (c.turn >> 26)];
  }
  CHECK(*std::min_element(counts.begin(), counts.end()) > 985);
  CHECK(*std::max_element(counts.begin(), counts.end()) < 1015);
}

TEST_CASE("octahedron: centres have unit length and return to their cells, so all cells are used") {
  for (const unsigned level : {0u, 1u, 2u, 5u, 8u, 16u}) {
    CAPTURE(level);
    const uint32_t side = 1u << level, step = std::max(1u, side / 256);
    size_t lost = 0;
    double worst = 0;
    for (uint32_t y = 0; y < side; y += step)
      for (uint32_t x = 0; x < side; x += step) {
        const wt_direction d = device::wt_octahedron_decode(x, y, level);
        lost += octahedral_cell(d, level) != std::pair(x, y);
        worst = std::max(worst, std::abs(length(d) - 1));
      }
    CHECK(lost == 0);
    CHECK(worst < 2e-7);
  }
}

TEST_CASE("octahedron: directions are near the centres of their cells, at any length") {
  Random random(5);
  for (const unsigned level : {1u, 4u, 8u, 12u, 16u}) {
    CAPTURE(level);
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
      const wt_direction d = random_direction(random);
      const auto [x, y] = octahedral_cell({d.x * 3, d.y * 3, d.z * 3}, level);
      const wt_direction e = device::wt_octahedron_decode(x, y, level);
      worst = std::max(worst, std::hypot(double{d.x} - e.x, double{d.y} - e.y, double{d.z} - e.z));
    }
    // Half a cell's diagonal is sqrt(2) / 2^level in the plane. Raising it to a face of the octahedron stretches by
    // sqrt(3) at most, projecting on the sphere by 1 / sqrt(1/3), both at the face's middle along the diagonal.
    CHECK(worst < 3 * std::numbers::sqrt2 / (1u << level) + 1e-6);
  }
}

TEST_CASE("octahedron: poles, axes and zeros of either sign") {
  for (const float zero : {0.0f, -0.0f}) {
    CHECK(octahedral_cell({zero, zero, 1}, 4) == std::pair(8u, 8u));
    CHECK(octahedral_cell({1, zero, zero}, 4) == std::pair(15u, 8u));
    CHECK(octahedral_cell({-1, zero, zero}, 4) == std::pair(0u, 8u));
    CHECK(octahedral_cell({zero, 1, zero}, 4) == std::pair(8u, 15u));
    CHECK(octahedral_cell({zero, -1, zero}, 4) == std::pair(8u, 0u));
    CHECK(octahedral_cell({zero, zero, -1}, 4) == std::pair(15u, 15u));  // one of the four corners
  }
  CHECK(octahedral_cell({0, 0, 0}, 4) == std::pair(0u, 0u));
  CHECK(octahedral_cell({not_a_number, not_a_number, not_a_number}, 4) == std::pair(0u, 0u));
}

TEST_CASE("cube cells: every bin is used, ends and what lies outside are kept in") {
  for (const unsigned bins : {1u, 2u, 3u, 7u, 64u, 1000u}) {
    CAPTURE(bins);
    std::set<uint32_t> used;
    for (int i = -5000; i <= 5000; ++i) {
      const float component = static_cast<float>(i) / 5000;
      const uint32_t bin = device::wt_cube_cell(component, bins);
      used.insert(bin);
      const double place = (double{component} + 1) / 2 * bins;
      CHECK(std::abs(place - bin - 0.5) <= 0.5 + 1e-4);  // in its bin, except for rounding at the borders
    }
    CHECK(used.size() == bins);
    CHECK(*used.rbegin() == bins - 1);
    CHECK(device::wt_cube_cell(-1.0f, bins) == 0);
    CHECK(device::wt_cube_cell(1.0f, bins) == bins - 1);
    CHECK(device::wt_cube_cell(std::nextafter(1.0f, 2.0f), bins) == bins - 1);
    CHECK(device::wt_cube_cell(-1e30f, bins) == 0);
    CHECK(device::wt_cube_cell(INFINITY, bins) == bins - 1);
    CHECK(device::wt_cube_cell(not_a_number, bins) == 0);
    CHECK(device::wt_cube_cell(-0.0f, bins) == bins / 2);
  }
  CHECK(device::wt_cube_cell(1.0f, 1u << 23) == (1u << 23) - 1);
}

TEST_CASE("the device's maps are the host's, bit for bit") {
  constexpr unsigned level = 11, bins = 100;
  std::vector<wt_direction> directions = hard_directions();
  Random random(7);
  while (directions.size() % 512 != 0) directions.push_back(random_direction(random));
  const size_t n = directions.size();
  std::vector<float> planes(3 * n), expected_centres(3 * n);
  std::vector<uint32_t> expected(5 * n);
  for (size_t i = 0; i < n; ++i) {
    const wt_direction& d = directions[i];
    planes[i] = d.x;
    planes[n + i] = d.y;
    planes[2 * n + i] = d.z;
    const Cylinder c = cylinder(d);
    const auto [x, y] = octahedral_cell(d, level);
    const uint32_t words[] = {c.height, c.turn, x, y, device::wt_cube_cell(d.x, bins)};
    for (size_t plane = 0; plane < 5; ++plane) expected[plane * n + i] = words[plane];
  }
  const std::vector<uint32_t> cells(expected.begin() + 2 * n, expected.begin() + 4 * n);
  for (size_t i = 0; i < n; ++i) {
    const wt_direction d = device::wt_octahedron_decode(cells[i], cells[n + i], level);
    expected_centres[i] = d.x;
    expected_centres[n + i] = d.y;
    expected_centres[2 * n + i] = d.z;
  }
  for (const uint32_t lanes : {1u, 16u}) {
    CAPTURE(lanes);
    const gpu::Definitions definitions{{"WT_LANES", std::to_string(lanes)}};
    const gpu::Range range{n / lanes, 16};
    auto words = context().buffer<uint32_t>(5 * n, "words");
    context().kernel("probe_direction_maps", "directions_to_words", definitions)(
        range, Stage::transfer, context().buffer(planes, "directions"), static_cast<uint32_t>(n), level, bins, words);
    CHECK(words.read() == expected);
    auto centres = context().buffer<float>(3 * n, "directions");
    context().kernel("probe_direction_maps", "cells_to_directions", definitions)(
        range, Stage::transfer, context().buffer(cells, "cells"), static_cast<uint32_t>(n), level, centres);
    CHECK(centres.read() == expected_centres);
  }
}
