// Finds the parts of a triangle that other triangles of its plane do not cover.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/convex_cut.hpp"

namespace wavetracer {

// A triangle that covers.
struct CoverTriangle {
  std::array<CutLine, 3> sides;  // in the plane that is covered, in the order in which they cut
  std::array<glm::dvec3, 3> corners;
};

// sides that the triangle shares with others of its surface cut last, so that they cut little; triangle_edges as
// find_edges() returns them, normal of the plane that is covered.
CoverTriangle cover_triangle(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges, uint32_t t,
                             const glm::dvec3& normal);

// The part of a polygon that a triangle covers; empty where that is narrower than welding moves vertices.
ConvexPolygon covered_part(const ConvexPolygon& polygon, const CoverTriangle& cover);

// Returns the parts that no triangle covers, as convex polygons that do not overlap, without those that are narrower
// than welding moves vertices. The time grows as n log n with the number of covers that are spread over the polygon.
std::vector<ConvexPolygon> uncovered_parts(ConvexPolygon polygon, std::span<const CoverTriangle> covers);

}  // namespace wavetracer
