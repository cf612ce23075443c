// SPDX-License-Identifier: Apache-2.0
// A table of heights has cells with equal shares of the rays, so a narrow cell is a dense one.
#include "simulation/launch_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

#include "passes/launch_heights.hpp"
#include "wavetracer/device/directions.h"
#include "wavetracer/device/elementary.h"

namespace wavetracer {
namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();
constexpr double turn_rad = 2 * WT_PI, sphere_sr = 2 * turn_rad;
constexpr double turn_units = 4294967296.0;  // parts of a turn in which windows give their width

// The solid angle that all rays would fill if they were everywhere as dense as at height z. heights: those of the
// table, falling; infinite above the first and below the last.
double fill_sr(std::span<const float> heights, double z, double azimuths_rad) {
  if (!(z <= heights.front()) || !(z >= heights.back())) return nowhere;
  const auto below = std::lower_bound(heights.begin() + 1, heights.end() - 1, z, std::greater<>());
  return (double{below[-1]} - *below) * WT_HEIGHT_CELLS * azimuths_rad;
}

glm::dvec3 window_axis(std::span<const float> table, unsigned axis) {
  const float* const v = table.data() + WT_WINDOW_AXES + 3 * axis;
  return {v[0], v[1], v[2]};
}

}  // namespace

double spread_m2(const Launcher& from, std::span<const float> tables, bool by_table, const glm::dvec3& at) {
  const std::span<const float> table =
      from.window || by_table ? tables.subspan(size_t{from.heights} * height_table_size) : std::span<const float>();
  if (!from.window) {
    const glm::dvec3 way = at - from.position_m;
    const double squared_m2 = glm::dot(way, way);
    if (!by_table || squared_m2 == 0) return squared_m2 * sphere_sr;
    const double z = std::clamp(way.z / std::sqrt(squared_m2), -1.0, 1.0);
    return squared_m2 * fill_sr(table.first(height_table_size), z, turn_rad);
  }
  const glm::dvec3 x = window_axis(table, 0), y = window_axis(table, 1), z = window_axis(table, 2);
  const glm::dvec3 way = at - (from.position_m - double{table[WT_WINDOW_AHEAD]} * x);
  const double squared_m2 = glm::dot(way, way), width_rad = table[WT_WINDOW_WIDTH] / turn_units * turn_rad;
  if (squared_m2 == 0) return 0;
  const double azimuth_rad = device::wt_atan2(glm::dot(way, y), glm::dot(way, x));
  if (2 * std::abs(azimuth_rad) > width_rad) return nowhere;
  return squared_m2 * fill_sr(table.first(height_table_size), glm::dot(way, z) / std::sqrt(squared_m2), width_rad);
}

double widest_spread_m2(std::span<const Launcher> launchers, std::span<const float> tables, bool by_table,
                        std::span<const Link> links, std::span<const EndState> receivers) {
  double widest_m2 = 0;
  auto from = launchers.begin();
  for (const Link& link : links) {
    while (from != launchers.end() && from->transmitter < link.tx) ++from;
    double densest_m2 = nowhere;
    for (auto one = from; one != launchers.end() && one->transmitter == link.tx; ++one)
      densest_m2 = std::min(densest_m2, spread_m2(*one, tables, by_table, receivers[link.rx].position_m));
    if (densest_m2 < nowhere) widest_m2 = std::max(widest_m2, densest_m2);
  }
  return widest_m2;
}

}  // namespace wavetracer
