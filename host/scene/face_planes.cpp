// A forest over both sides of all surfaces.
#include "scene/face_planes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "scene/topology.hpp"

namespace wavetracer {

using glm::dvec3;

FacePlanes::FacePlanes(const Scene& scene) : scene_(scene), parent_(2 * scene.surfaces.size()) {
  std::iota(parent_.begin(), parent_.end(), 0u);
  for (const Edge& edge : scene.edges) {
    if (!edge.flat) continue;
    const uint32_t first = scene.triangle_surface[scene.edge_faces[edge.first_face]];
    const dvec3 &normal = scene.surfaces[first].normal, &at = scene.vertices[edge.vertices[0]];
    for (uint32_t k = 1; k < edge.face_count; ++k) {
      const uint32_t other = scene.triangle_surface[scene.edge_faces[edge.first_face + k]];
      join(first, other, normal, at);
      join(first, other, -normal, at);
    }
  }
}

void FacePlanes::join(uint32_t surface, uint32_t other, const dvec3& front, const dvec3& at) {
  if (surface == other || !same_plane(scene_.surfaces[surface], scene_.surfaces[other], at)) return;
  const uint32_t a = root(side(surface, front)), b = root(side(other, front));
  parent_[std::max(a, b)] = std::min(a, b);
}

void FacePlanes::number(std::span<Wedge> wedges) {
  for (Wedge& wedge : wedges) {
    const dvec3 last = wedge.face * std::sin(wedge.exterior_rad) - wedge.normal * std::cos(wedge.exterior_rad);
    wedge.plane = {root(side(wedge.surface[0], wedge.normal)) / 2, root(side(wedge.surface[1], last)) / 2};
  }
}

uint32_t FacePlanes::side(uint32_t surface, const dvec3& front) const {
  return 2 * surface + (glm::dot(scene_.surfaces[surface].normal, front) < 0);
}

uint32_t FacePlanes::root(uint32_t side) {
  while (parent_[side] != side) side = parent_[side] = parent_[parent_[side]];
  return side;
}

}  // namespace wavetracer
