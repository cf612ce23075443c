// SPDX-License-Identifier: Apache-2.0
// Polygons on a grid of 1/1024 m: every test of sides, crossings and containment is exact in 64-bit integers.
// Coordinates must be below 2^24 grid units (16 km), which float32 meshes hold exactly, and rings within max_size.
#pragma once
#include <array>
#include <compare>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace wavetracer::imports {

constexpr int64_t grid_per_m = 1024;
constexpr double largest_coordinate_m = 16384;
constexpr int64_t max_size = 4096 * grid_per_m;  // largest size of a footprint, so that sums of areas cannot overflow
// Limit of a footprint: checking and triangulating take time that grows as the square.
constexpr size_t max_corners = 5000;

struct Point {
  int64_t x = 0, y = 0;
  auto operator<=>(const Point&) const = default;
};

using Ring = std::vector<Point>;  // the first point is not repeated

struct Polygon {
  Ring outer;               // counter-clockwise
  std::vector<Ring> holes;  // clockwise
};

struct Box {
  Point lower, upper;
  bool contains(const Box& other) const {
    return lower.x <= other.lower.x && lower.y <= other.lower.y && upper.x >= other.upper.x && upper.y >= other.upper.y;
  }
};

// Returns twice the signed area of (a, b, c): positive if c is left of a -> b.
inline int64_t turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
// Tells whether p lies on the closed segment a - b.
bool on_segment(const Point& a, const Point& b, const Point& p);
// Tells whether the closed segments a - b and c - d have a point in common.
bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d);

// Returns the points on the grid, without equal neighbours and without a last point that repeats the first.
Ring make_ring(std::span<const glm::dvec2> points_m);
Box box_of(const Ring& ring);
int64_t twice_area(const Ring& ring);  // positive if counter-clockwise
double area_m2(const Polygon& polygon);
void orient(Polygon& polygon);  // turns rings into the orientation of Polygon
// Tells whether p is inside the ring; for a point on the border either answer is possible.
bool contains(const Ring& ring, const Point& p);

constexpr std::string_view crossing_outline = "outline that crosses or touches itself";

// Returns why this is no valid polygon with holes: rings that cross, touch, fold back, are empty, or are out of place.
// It is empty for a valid polygon. Sizes are checked first, so any rings may be given.
std::string_view fault(const Polygon& polygon);
// Tells whether a valid polygon stays valid with this hole added, which is itself a valid ring.
bool fits(const Polygon& polygon, const Ring& hole);

// Returns the share of the area of a polygon that lies in at least one of the others, 0 to 1. It is exact along x and
// measured on 256 lines along y, so the error is a few parts in a thousand.
double covered_share(const Polygon& polygon, std::span<const Polygon* const> others);

}  // namespace wavetracer::imports
