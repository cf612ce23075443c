// The slow, obvious oracle: every sequence of surfaces is tried, every leg is tested against every triangle, in double.
// Shares no code with the ray tracer; meant for scenes of up to about 60 surfaces and 3 reflections.
#pragma once
#include <glm/vec3.hpp>
#include <vector>
#include "wavetracer/path_geometry.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer::reference {

// All line-of-sight and specular paths with at most max_order reflections, by the image method.
// Positions and vertices are recentred, as the scene is. Rows are sorted by tx, rx, order, then surfaces.
//
// What counts as a path:
// - a sequence never names one surface twice in a row;
// - each point lies inside its surface, borders included (to 1e-9 of the triangle's size), and both neighbours of the
//   point are on the same side of the surface's plane;
// - no leg is blocked. A surface blocks a leg when the leg crosses one of its triangles, both ends of the leg lie on
//   opposite sides of its plane and farther than 1e-4 m from it, and the leg neither starts nor ends on that surface;
// - of paths of one transmitter, receiver and order whose vertices agree within 1e-4 m, the first is kept: a point on
//   the border of two coplanar surfaces is one path.
// Positions should be generic: a path through the exact corner of two walls is left to rounding.
PathGeometry brute_force_paths(const Scene& scene, const std::vector<glm::dvec3>& transmitters,
                               const std::vector<glm::dvec3>& receivers, uint32_t max_order);

// The length of path i, legs added up from the transmitter on.
double path_length_m(const PathGeometry& paths, size_t i, const glm::dvec3& transmitter, const glm::dvec3& receiver);

}  // namespace wavetracer::reference
