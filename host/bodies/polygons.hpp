// SPDX-License-Identifier: Apache-2.0
// Convex polygons in space, cut by planes. An empty polygon has no corners.
#pragma once
#include <vector>

#include "bodies/body.hpp"
#include "scene/plane_fit.hpp"

namespace wavetracer {

inline Plane flipped(const Plane& plane) { return {-plane.normal, -plane.offset_m}; }

// Half the sum of cross products of its corners: along the normal, as long as the area in m^2.
glm::dvec3 area_vector(const Polygon& polygon);
Plane plane_of(const Polygon& polygon);
// The mean of all its points. The polygon has an area.
glm::dvec3 centroid(const Polygon& polygon);

// The part of the polygon that is more than tolerance_m above the plane somewhere, and nowhere below it; corners that
// are nearer than the tolerance are taken to lie on the plane.
Polygon part_above(const Polygon& polygon, const Plane& plane, double tolerance_m);

// The planes through the source and the edges of a polygon that does not contain it, all with the polygon above them.
// There are none if the source is in the polygon's plane.
std::vector<Plane> pyramid(glm::dvec3 source, const Polygon& polygon, double tolerance_m);

// Replaces the polygons by what is left of them outside of the planes' common upper side.
void subtract(std::vector<Polygon>& polygons, const std::vector<Plane>& planes, double tolerance_m);

}  // namespace wavetracer
