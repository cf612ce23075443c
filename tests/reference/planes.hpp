// SPDX-License-Identifier: Apache-2.0
// Planes, triangles and legs in double: the geometry under the brute force, with no acceleration of any kind. Planes
// must be exact: a surface's normal has unit length and its triangles lie in its plane.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>
#include "wavetracer/scene.hpp"

namespace wavetracer::reference {

constexpr double plane_distance_m = 1e-4;     // points nearer to a plane than this are neither before nor behind it
constexpr double same_vertex_m = 1e-4;        // points nearer to each other than this are one
constexpr uint32_t no_surface = 0xFFFFFFFFu;  // the "surface" of a transmitter, a receiver or a wedge

// Signed distance from the plane.
double height(const Surface& surface, const glm::dvec3& point);
glm::dvec3 mirrored(const Surface& surface, const glm::dvec3& point);
// Borders included, to 1e-9 of the triangle's size. The point is known to lie in the surface's plane.
bool inside_surface(const Scene& scene, uint32_t index, const glm::dvec3& point);
// Returns the point where the line from a to b meets the plane, if that is strictly between them.
std::optional<glm::dvec3> crossing(const Surface& surface, const glm::dvec3& a, const glm::dvec3& b);

// A surface that a leg passes, and the place.
struct Passage {
  double distance_m = 0;  // from the start of the leg
  uint32_t surface = 0;
  glm::dvec3 point{0};
};

// The point where a leg begins or ends.
struct Stop {
  glm::dvec3 point{0};
  bool antenna = true;            // false for an interaction
  std::vector<uint32_t> on = {};  // the surfaces that it is on: one for a reflection, two for a wedge
  glm::dvec3 front{0};            // for an interaction on surfaces: a unit vector from them towards the leg
};

// Returns the surfaces between a and b, nearest to a first; `before` is the point before a on the path, or a. Three
// kinds do not count: a surface that a or b is on; for an antenna, one whose plane is within plane_distance_m of it;
// for an interaction, one that lies within plane_distance_m of it in one plane with a surface that it is on. An
// interaction in the plane of any other surface is on the side of `before`. The test whether the leg is inside of a
// surface is made half a millimetre in front of interactions. Surfaces that lie on one another, or side by side in one
// plane, are passed once: crossings of parallel planes within same_vertex_m are one, of the first surface.
std::vector<Passage> passages(const Scene& scene, const Stop& before, const Stop& a, const Stop& b);

// The same between two points that are on one surface each, or none, if no other is near them.
std::vector<Passage> passages(const Scene& scene, const glm::dvec3& a, uint32_t a_surface, const glm::dvec3& b,
                              uint32_t b_surface);

}  // namespace wavetracer::reference
