// Polygons on a grid of 1/1024 m: every test of sides, crossings and containment is exact in 64-bit integers.
// Assumes coordinates below 2^24 grid units (16 km), which float32 meshes hold exactly, and rings within max_size.
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
constexpr int64_t max_size = 4096 * grid_per_m;  // of a footprint, so that sums of areas cannot overflow
constexpr size_t max_corners = 5000;             // of a footprint: checking and triangulating take their square

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

// Twice the signed area of (a, b, c): positive where c is left of a -> b.
inline int64_t turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
// Whether p lies on the closed segment a - b.
bool on_segment(const Point& a, const Point& b, const Point& p);
// Whether the closed segments a - b and c - d have a point in common.
bool segments_meet(const Point& a, const Point& b, const Point& c, const Point& d);

// The points on the grid, without neighbours that are equal and without a last one that repeats the first.
Ring make_ring(std::span<const glm::dvec2> points_m);
Box box_of(const Ring& ring);
int64_t twice_area(const Ring& ring);  // positive: counter-clockwise
double area_m2(const Polygon& polygon);
void orient(Polygon& polygon);  // turns rings as Polygon wants them
// Whether p is inside of the ring; on its border either answer.
bool contains(const Ring& ring, const Point& p);

constexpr std::string_view crossing_outline = "outline that crosses or touches itself";

// Why this is no polygon with holes: rings that cross, touch, fold back, hold nothing or are out of place. Empty where
// it is one. Sizes are checked first, so that any rings may be given.
std::string_view fault(const Polygon& polygon);
// Whether a polygon without a fault stays one with this hole too, a ring without a fault.
bool fits(const Polygon& polygon, const Ring& hole);

}  // namespace wavetracer::imports
