// Straight walls of maps whose coordinates are coarse: a corner that only rounding has put beside a wall goes onto it.
// Assumes rings in metres, in which corners that buildings share are equal to the last bit.
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
  std::map<glm::dvec2, glm::dvec2, LessPoint> moved;  // corner -> its new place
  double farthest_m = 0;
  // A footprint on the grid, with its corners in their new places, shifted.
  Polygon polygon_of(const Footprint& footprint, const glm::dvec2& shift) const;
};

// rounding_m: the most by which a coordinate is off. A corner goes onto a wall within two and a half times of it, since
// the ends of the wall are rounded too. Walls go on across corners of two buildings, as along a row of houses. A row of
// walls between two corners is straight where all between are within the tolerance of the line; else it is divided at
// the farthest (Douglas and Peucker 1973). Ends of rows stay where they are. The result does not depend on the order of
// footprints.
StraightWalls straight_walls(std::span<const Footprint> footprints, double rounding_m);

// Steps of decimals, as files are written with. Coordinates with fewer were not rounded but chosen.
inline constexpr std::array degree_steps{1e-6, 1e-7, 1e-8}, metre_steps{1e-2, 1e-3, 1e-4};

// The rounding of coordinates that are all multiples of one of the steps, given from the largest to the smallest: half
// of it. Zero where they are multiples of none.
double rounding_of(std::span<const Footprint> footprints, std::span<const double> steps);

}  // namespace wavetracer::imports
