// SPDX-License-Identifier: Apache-2.0
// Finds the parts of a triangle that other triangles of its plane do not cover.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/convex_cut.hpp"

namespace wavetracer {

// A triangle that covers others.
struct CoverTriangle {
  std::array<CutLine, 3> sides;  // lines in the plane that is covered, in the order in which they cut
  std::array<glm::dvec3, 3> corners;
};

// Makes a cover of triangle t. Sides that it shares with other triangles of its surface cut last, so that they cut
// little. triangle_edges: as find_edges() returns them; normal: of the plane that is covered.
CoverTriangle cover_triangle(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges, uint32_t t,
                             const glm::dvec3& normal);

// Returns the part of a polygon that a triangle covers, or an empty polygon if that is narrower than the distance by
// which welding moves vertices.
ConvexPolygon covered_part(const ConvexPolygon& polygon, const CoverTriangle& cover);

// Returns the parts that no triangle covers, as convex polygons that do not overlap, without parts narrower than the
// distance by which welding moves vertices. For n covers spread over the polygon, the time grows as n log n.
std::vector<ConvexPolygon> uncovered_parts(ConvexPolygon polygon, std::span<const CoverTriangle> covers);

}  // namespace wavetracer
