// SPDX-License-Identifier: Apache-2.0
// Cuts convex polygons by lines of their plane. All is in double and in space, so no coordinates of the plane are
// needed.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

using ConvexPolygon = std::vector<glm::dvec3>;  // corners in metres, in one plane, all turning in the same sense

// The line through a side: dot(inwards, p) = offset_m, where inwards is a unit vector of the plane.
struct CutLine {
  glm::dvec3 inwards;
  double offset_m;
  double beyond_m(const glm::dvec3& p) const;  // Returns the distance of p from the line, positive on the inner side.
};

// Returns the sides of triangle t of the scene as lines of a plane that it lies in and that has this normal; side k is
// between corners k and k + 1.
std::array<CutLine, 3> side_lines(const Scene& scene, uint32_t t, const glm::dvec3& normal);

// Tells whether two triangles, which are about in one plane, overlap by more than the distance by which welding moves
// vertices: no side of either has the other entirely on its outer side. The normals are those of their planes.
bool overlap_in_plane(const Scene& scene, uint32_t t, const glm::dvec3& normal, uint32_t other,
                      const glm::dvec3& other_normal);

// The two parts of a polygon; one is empty where the line does not cut it. Corners within touch_m of the line count as
// on it, so that no part is narrower than that. The winding is kept.
struct CutParts {
  ConvexPolygon outside, inside;
};
CutParts cut_convex(const ConvexPolygon& polygon, const CutLine& line, double touch_m);

double polygon_area_m2(const ConvexPolygon& polygon);
// Returns the least distance of two parallel lines with the polygon between them; 0 for fewer than three corners.
double polygon_width_m(const ConvexPolygon& polygon);
// Returns the corner numbers of triangles that fill a polygon of at least three corners. Among all fans, it takes the
// one whose lowest triangle is highest.
std::vector<std::array<size_t, 3>> best_fan(const ConvexPolygon& polygon);

}  // namespace wavetracer
