// SPDX-License-Identifier: Apache-2.0
// Scenes made of parallelograms, one surface each, and their wedges, for tests whose answers are closed forms. There is
// no loader and no welding: the scene has exactly what is written.
#pragma once
#include <glm/vec3.hpp>
#include <vector>
#include "wavetracer/scene.hpp"

namespace wavetracer::reference {

// Corners corner, corner + u, corner + u + v, corner + v; the normal is that of u x v.
struct Quad {
  glm::dvec3 corner, u, v;
};

// Surface i is quad i. There is one material, "metal", and the origin is 0.
Scene scene_of_quads(const std::vector<Quad>& quads);

// The six walls of a box, in the order x lower, x upper, y lower, y upper, z lower, z upper.
std::vector<Quad> box_walls(const glm::dvec3& lower, const glm::dvec3& upper);

// The twelve edges of a solid box in free space, whose walls are surfaces first_surface + 0 to 5 in that order. First
// the four along z, then those along x, then those along y.
std::vector<Wedge> box_wedges(const glm::dvec3& lower, const glm::dvec3& upper, uint32_t first_surface = 0);

// The four edges of a quad that stands alone, surface number `surface`: half planes, in the order of its corners.
std::vector<Wedge> free_wedges(const Quad& quad, uint32_t surface);

}  // namespace wavetracer::reference
