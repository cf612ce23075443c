// SPDX-License-Identifier: Apache-2.0
// Straightens walls of maps with coarse coordinates: a corner that lies beside a wall only because of rounding is moved
// onto it. Rings are in metres, and corners that buildings share must be exactly equal.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <map>
#include <span>
#include <vector>

#include "imports/map.hpp"
#include "imports/rings.hpp"

namespace wavetracer::imports {

struct LessPoint {
  bool operator()(const glm::dvec2& a, const glm::dvec2& b) const { return a.x != b.x ? a.x < b.x : a.y < b.y; }
};

struct StraightWalls {
  std::map<glm::dvec2, glm::dvec2, LessPoint> moved;  // new place of each corner
  double farthest_m = 0;
  // Returns a footprint on the grid with its corners in their new places, shifted.
  Polygon polygon_of(const Footprint& footprint, const glm::dvec2& shift) const;
};

// rounding_m: the largest error of a coordinate. A corner is moved onto a wall within two and a half times of it, since
// the ends of the wall are rounded too. Walls continue across corners of two buildings, such as along a row of houses.
// A row of walls between two corners is straight if all corners between are within the tolerance of the line; else it
// is divided at the farthest one (Douglas and Peucker 1973). Ends of rows are not moved. The result does not depend on
// the order of footprints.
StraightWalls straight_walls(std::span<const Footprint> footprints, double rounding_m);

// Decimal steps with which files are written. Coordinates with fewer decimals were chosen, not rounded.
inline constexpr std::array degree_steps{1e-6, 1e-7, 1e-8}, metre_steps{1e-2, 1e-3, 1e-4};

// Returns half of the largest step of which all coordinates are multiples, or zero if there is none; steps are given
// from the largest to the smallest.
double rounding_of(std::span<const Footprint> footprints, std::span<const double> steps);

}  // namespace wavetracer::imports
