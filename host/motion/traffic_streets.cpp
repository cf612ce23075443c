// SPDX-License-Identifier: Apache-2.0
// The geometry of lanes and turns: straight lines and quarter circles that begin and end at the edges of a crossing.
// Only poses use trigonometry: the decisions of the simulation are the same on every platform.
#include "motion/traffic_streets.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr double lane_offset_m = 3;  // distance of a lane's middle from the centre line of the street
// Allows a right turn of radius 3 m in which the corners of the longest vehicle stay on their side of the street.
constexpr uint32_t narrowest_street_m = 12;

constexpr std::array<std::array<int, 2>, 4> directions = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

glm::dvec3 direction(uint32_t d) { return {directions[d % 4][0], directions[d % 4][1], 0}; }

// Returns the number of quarter turns counter-clockwise.
uint32_t quarters(Turn turn) { return turn == Turn::left ? 1 : turn == Turn::right ? 3 : 0; }

}  // namespace

Streets::Streets(const StreetGrid& grid) : grid_(grid) {
  if (grid.street_m < narrowest_street_m) {
    throw ConfigError(fmt::format("streets of {} m are too narrow for traffic; it needs --street-m {} or more",
                                  grid.street_m, narrowest_street_m));
  }
}

bool Streets::exists(uint32_t lane) const {
  const uint32_t crossing = lane / 4, row = grid_.blocks_x + 1;
  const uint32_t i = crossing % row, j = crossing / row;
  switch (lane % 4) {
    case 0:
      return i < grid_.blocks_x;
    case 1:
      return j < grid_.blocks_y;
    case 2:
      return i > 0;
    default:
      return j > 0;
  }
}

uint32_t Streets::crossing_after(uint32_t lane) const {
  const auto& [dx, dy] = directions[lane % 4];
  return lane / 4 + static_cast<uint32_t>(dx) + static_cast<uint32_t>(dy) * (grid_.blocks_x + 1);
}

uint32_t Streets::lane_after(uint32_t lane, Turn turn) const {
  return 4 * crossing_after(lane) + (lane + quarters(turn)) % 4;
}

bool Streets::compatible(uint32_t lane_a, Turn turn_a, uint32_t lane_b, Turn turn_b) {
  const uint32_t between = (lane_a - lane_b) % 4;
  return between == 0 || (between == 2 && turn_a != Turn::left && turn_b != Turn::left);
}

double Streets::radius_m(Turn turn) const {
  return grid_.street_m / 2.0 + (turn == Turn::left ? lane_offset_m : -lane_offset_m);
}

double Streets::way_m(Turn turn) const {
  return turn == Turn::straight ? grid_.street_m : std::numbers::pi / 2 * radius_m(turn);
}

glm::dvec3 Streets::centre_m(uint32_t crossing) const {
  const double pitch_m = grid_.block_m + grid_.street_m;
  const uint32_t row = grid_.blocks_x + 1;
  return {(crossing % row - grid_.blocks_x / 2.0) * pitch_m, (crossing / row - grid_.blocks_y / 2.0) * pitch_m, 0};
}

Streets::Place Streets::at(uint32_t lane, Turn turn, double along_m) const {
  const glm::dvec3 ahead = direction(lane), left = direction(lane + 1);
  const glm::dvec3 begin_m = centre_m(lane / 4) + grid_.street_m / 2.0 * ahead - lane_offset_m * left;
  const double yaw_rad = std::numbers::pi / 2 * (lane % 4);
  if (along_m <= lane_m() || turn == Turn::straight) return {begin_m + along_m * ahead, yaw_rad};
  const double r = radius_m(turn), angle_rad = (along_m - lane_m()) / r, side = turn == Turn::left ? 1 : -1;
  const glm::dvec3 end_m = begin_m + lane_m() * ahead;
  return {end_m + r * std::sin(angle_rad) * ahead + side * r * (1 - std::cos(angle_rad)) * left,
          std::remainder(yaw_rad + side * angle_rad, 2 * std::numbers::pi)};
}

}  // namespace wavetracer
