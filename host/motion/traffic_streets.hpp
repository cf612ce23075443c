// SPDX-License-Identifier: Apache-2.0
// The lanes of a grid of streets: their places, their connections at crossings, and the poses along them.
// Traffic keeps to the right; every street has one lane each way. A lane begins where it leaves a crossing.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

namespace wavetracer {

// Square blocks between straight streets, centred on the origin at z = 0: centre lines run along
// x = (i - blocks_x / 2) * (block_m + street_m), i = 0 .. blocks_x, and likewise in y.
struct StreetGrid {
  uint32_t blocks_x, blocks_y, block_m, street_m;
};

enum class Turn { straight, left, right };

class Streets {
 public:
  // Throws ConfigError if the streets are too narrow for vehicles to pass and turn.
  explicit Streets(const StreetGrid& grid);

  uint32_t crossing_count() const { return (grid_.blocks_x + 1) * (grid_.blocks_y + 1); }
  // Lane 4 * crossing + d leaves the crossing in direction d, counter-clockwise from +x; it may lead out of the grid.
  uint32_t lane_count() const { return 4 * crossing_count(); }
  bool exists(uint32_t lane) const;
  double lane_m() const { return grid_.block_m; }

  // For lanes that exist: the crossing at the end, and the lane that a turn there leads to.
  uint32_t crossing_after(uint32_t lane) const;
  uint32_t lane_after(uint32_t lane, Turn turn) const;
  // Tells whether the ways of two vehicles over a crossing do not touch, except one behind the other: they come from
  // one lane, or from opposite ones and neither turns left.
  static bool compatible(uint32_t lane_a, Turn turn_a, uint32_t lane_b, Turn turn_b);

  // The length of the way over a crossing, and the radius of its arc; straight ways have no radius.
  double way_m(Turn turn) const;
  double radius_m(Turn turn) const;

  struct Place {
    glm::dvec3 position_m;
    double yaw_rad;
  };
  // along_m counts from the beginning of the lane and goes on over the crossing, up to lane_m() + way_m(turn).
  Place at(uint32_t lane, Turn turn, double along_m) const;

 private:
  glm::dvec3 centre_m(uint32_t crossing) const;

  StreetGrid grid_;
};

}  // namespace wavetracer
