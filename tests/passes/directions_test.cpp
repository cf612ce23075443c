// SPDX-License-Identifier: Apache-2.0
// Maps from launch index to direction: equal solid angles, unit length, and neighbours in index that are neighbours on
// the sphere. The results of devices are tested with generate_rays.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "passes/host_launch.hpp"
#include "passes/launch_heights.hpp"
#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr Directions all_maps[] = {"horizon", "hilbert", "fibonacci", "random"};

// Returns all directions of a launch of n rays; heights of "horizon" are denser in a narrow and in a wide band.
std::vector<Float3> directions_of(Directions map, uint64_t n) {
  const HeightShare shares[] = {{2, 0.01, false}, {1, 0.1, true}};
  static const std::vector<float> heights = height_table(shares, 0.25);
  const HostLaunch launch(map, n, 42);
  std::vector<Float3> out;
  for (uint64_t i = 0; i < n; ++i) {
    const device::wt_direction d = launch.direction(i, heights.data());
    out.push_back({d.x, d.y, d.z});
  }
  return out;
}

// The units are the sphere's area over n rays' shares: z from -1 to 1, then the azimuth in turns.
std::pair<double, double> cylinder(const Float3& d) {
  const double turn = std::atan2(double{d[1]}, double{d[0]}) / (2 * std::numbers::pi);
  return {(1 - double{d[2]}) / 2, turn < 0 ? turn + 1 : turn};
}

double mean_step_rad(const std::vector<Float3>& directions) {
  double sum = 0;
  for (size_t i = 1; i < directions.size(); ++i) {
    const glm::dvec3 a = to_double(directions[i - 1]), b = to_double(directions[i]);
    sum += std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  }
  return sum / static_cast<double>(directions.size() - 1);
}

// Pearson's statistic of the counts in bands x turns bins of equal area.
double chi_square(const std::vector<Float3>& directions, size_t bands, size_t turns) {
  std::vector<double> counts(bands * turns, 0);
  for (const Float3& d : directions) {
    const auto [height, turn] = cylinder(d);
    const size_t band = std::min(static_cast<size_t>(height * static_cast<double>(bands)), bands - 1);
    counts[band * turns + std::min(static_cast<size_t>(turn * static_cast<double>(turns)), turns - 1)] += 1;
  }
  const double expected = static_cast<double>(directions.size()) / static_cast<double>(counts.size());
  double sum = 0;
  for (const double count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

}  // namespace

TEST_CASE("directions have unit length") {
  for (const Directions map : all_maps) {
    CAPTURE(map);
    double worst = 0;
    for (const Float3& d : directions_of(map, 100000)) worst = std::max(worst, std::abs(glm::length(to_double(d)) - 1));
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("equal solid angles: chi-square over 192 bins of equal area") {
  // For independent samples the statistic has mean 191 and standard deviation 19.5; its 99.9 % point is 257.
  CHECK(chi_square(directions_of("random", 100000), 12, 16) < 257);
  CHECK(chi_square(directions_of("random", 100000), 12, 16) > 135);  // the 0.1 % point: suspiciously even below
  // Even maps are far below it: a bin is wrong by the cells on its border at most.
  for (const uint64_t n : {uint64_t{3072}, uint64_t{100000}, uint64_t{65537}}) {
    CAPTURE(n);
    CHECK(chi_square(directions_of("hilbert", n), 12, 16) < 20);
    CHECK(chi_square(directions_of("fibonacci", n), 12, 16) < 20);
  }
}

TEST_CASE("hilbert: each of 3 x 32 x 32 cells of equal area has one of 3,072 rays") {
  std::set<std::pair<int, int>> cells;
  for (const Float3& d : directions_of("hilbert", 3072)) {
    const auto [height, turn] = cylinder(d);
    cells.emplace(static_cast<int>(height * 32), static_cast<int>(turn * 96));
  }
  CHECK(cells.size() == 3072);
}

TEST_CASE("hilbert and fibonacci: heights are evenly spread, and no two rays are the same") {
  constexpr uint64_t n = 10240;  // ten faces of 1,024 cells, whose heights are steps of 1 / 1,024
  for (const Directions map : std::to_array<Directions>({"hilbert", "fibonacci"})) {
    CAPTURE(map);
    std::vector<Float3> directions = directions_of(map, n);
    std::vector<double> heights;
    for (const Float3& d : directions) heights.push_back(cylinder(d).first);
    std::sort(heights.begin(), heights.end());
    double worst = 0;  // the star discrepancy in one dimension
    for (size_t i = 0; i < heights.size(); ++i)
      worst = std::max(worst, std::abs(heights[i] - (static_cast<double>(i) + 0.5) / n));
    CHECK(worst < 1.0 / 1024);
    std::sort(directions.begin(), directions.end());
    CHECK(std::adjacent_find(directions.begin(), directions.end()) == directions.end());
  }
}

TEST_CASE("hilbert: consecutive rays are neighbours on the sphere") {
  // Neighbours of a square lattice are sqrt(4 pi / n) apart; offsets inside the cells and their stretch towards the
  // poles cost about a factor of two for every n.
  for (const uint64_t n : {uint64_t{3072}, uint64_t{50000}, uint64_t{200000}}) {
    CAPTURE(n);
    const double lattice = std::sqrt(4 * std::numbers::pi / static_cast<double>(n));
    CHECK(mean_step_rad(directions_of("hilbert", n)) < 2.5 * lattice);
    CHECK(mean_step_rad(directions_of("fibonacci", n)) > 10 * lattice);  // golden-ratio turns: far apart
  }
}

TEST_CASE("the Hilbert curve visits every cell once, by unit steps") {
  for (const unsigned level : {1u, 2u, 5u, 8u}) {
    CAPTURE(level);
    std::set<std::pair<uint32_t, uint32_t>> visited;
    uint32_t before_x = 0, before_y = 0, jumps = 0;
    for (uint32_t i = 0; i < 1u << (2 * level); ++i) {
      uint32_t x, y;
      device::wt_hilbert_cell(i << (32 - 2 * level), &x, &y);
      x >>= 16 - level;
      y >>= 16 - level;
      visited.emplace(x, y);
      const int step = std::abs(static_cast<int>(x - before_x)) + std::abs(static_cast<int>(y - before_y));
      jumps += i > 0 && step != 1;
      before_x = x;
      before_y = y;
    }
    CHECK(visited.size() == 1u << (2 * level));
    CHECK(jumps == 0);
  }
}
