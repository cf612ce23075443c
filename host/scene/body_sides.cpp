// SPDX-License-Identifier: Apache-2.0
// The side follows from the corners of neighbouring faces that lie off the surface's plane.
#include "scene/body_sides.hpp"

#include <glm/geometric.hpp>

#include "scene/topology.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
// Part of the way from a sheet to the body that stands on it, up to which they count as one.
constexpr double upright_z = 0.7;

struct BorderSides {
  bool free = true, above = false, below = false;  // free: no other face shares the edge
};

// Returns the sides to which other faces at a triangle's edge lie; none where the surface continues beyond the edge.
BorderSides sides_at(const Scene& scene, uint32_t t, const Edge& edge) {
  const uint32_t own = scene.triangle_surface[t];
  const Surface& surface = scene.surfaces[own];
  BorderSides same_mesh, any;
  for (uint32_t i = 0; i < edge.face_count; ++i) {
    const uint32_t other = scene.edge_faces[edge.first_face + i];
    if (other == t) continue;
    if (scene.triangle_surface[other] == own) return {false, false, false};
    const double height_m = glm::dot(surface.normal, scene.vertices[apex(scene, other, edge)]) - surface.offset_m;
    const auto note = [&](BorderSides& sides) {
      sides.free = false;
      sides.above |= height_m > flat_as_it_is_m;
      sides.below |= height_m < -flat_as_it_is_m;
    };
    note(any);
    if (scene.triangle_object[other] == scene.triangle_object[t]) note(same_mesh);
  }
  return same_mesh.above || same_mesh.below ? same_mesh : any;
}

}  // namespace

int BodySides::find_side(uint32_t surface) const {
  const Surface& s = scene_.surfaces[surface];
  bool above = false, below = false;
  for (uint32_t k = 0; k < s.triangle_count; ++k) {
    const uint32_t t = scene_.surface_triangles[s.first_triangle + k];
    for (const uint32_t e : triangle_edges_[t]) {
      const BorderSides sides = sides_at(scene_, t, scene_.edges[e]);
      if (sides.free) return 0;
      if (sides.above == sides.below) continue;  // the surface continues in its plane, or touches another body
      above |= sides.above;
      below |= sides.below;
    }
  }
  return static_cast<int>(above && !below) - static_cast<int>(below && !above);
}

int BodySides::side(uint32_t surface) {
  std::optional<int>& known = known_[surface];
  if (!known) known = find_side(surface);
  return *known;
}

bool BodySides::hidden_between(uint32_t surface, uint32_t other) {
  const dvec3 &n = scene_.surfaces[surface].normal, &m = scene_.surfaces[other].normal;
  const int here = side(surface), there = side(other);
  if (here != 0 && there != 0) return here * (glm::dot(n, m) < 0 ? -there : there) < 0;
  return here * n.z > upright_z || there * m.z > upright_z;
}

}  // namespace wavetracer
