// Convex polygons of a plane, cut by lines of that plane. In double and in space, so no coordinates of the plane are
// needed.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

using ConvexPolygon = std::vector<glm::dvec3>;  // corners in metres, in the plane, all turns in one sense

// The line of a side: dot(inwards, p) = offset_m, where inwards is a unit vector of the plane.
struct CutLine {
  glm::dvec3 inwards;
  double offset_m;
  double beyond_m(const glm::dvec3& p) const;  // how far p is inwards of the line
};

// The sides of triangle t of the scene, as lines of a plane with this normal in which it lies; side k is between
// corners k and k + 1.
std::array<CutLine, 3> side_lines(const Scene& scene, uint32_t t, const glm::dvec3& normal);

// Does a side of triangle t, in a plane with this normal, have all of the other triangle outside of it, but for
// touch_m?
bool parted_by_a_side(const Scene& scene, uint32_t t, uint32_t other, const glm::dvec3& normal, double touch_m);

// Both parts of a polygon; one is empty where the line does not cut it. Corners within touch_m of the line are on it,
// so that no part is narrower. The winding is kept.
struct CutParts {
  ConvexPolygon outside, inside;
};
CutParts cut_convex(const ConvexPolygon& polygon, const CutLine& line, double touch_m);

double polygon_area_m2(const ConvexPolygon& polygon);
// The least distance of two parallel lines that hold the polygon between them; 0 for less than three corners.
double polygon_width_m(const ConvexPolygon& polygon);
// Corner numbers of triangles that fill a polygon of at least three corners: the fan whose lowest triangle is highest.
std::vector<std::array<size_t, 3>> best_fan(const ConvexPolygon& polygon);

}  // namespace wavetracer
