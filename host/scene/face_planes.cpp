// Keeps a forest over both sides of all surfaces.
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
  const uint32_t a = root(side(surface, front)), b = root(side(other, front));
  if (a != b && in_one_plane(surface, other, at)) parent_[std::max(a, b)] = std::min(a, b);
}

bool FacePlanes::in_one_plane(uint32_t surface, uint32_t other, const dvec3& at) {
  if (same_plane(scene_.surfaces[surface], scene_.surfaces[other], at)) return true;
  const auto pair = std::minmax(surface, other);
  if (apart_.contains(pair)) return false;
  if (all_near(surface, other) && all_near(other, surface)) return true;
  apart_.insert(pair);
  return false;
}

bool FacePlanes::all_near(uint32_t surface, uint32_t other) const {
  const Surface &from = scene_.surfaces[surface], &to = scene_.surfaces[other];
  for (uint32_t i = 0; i < from.triangle_count; ++i)
    for (const uint32_t v : scene_.triangles[scene_.surface_triangles[from.first_triangle + i]])
      if (std::abs(glm::dot(to.normal, scene_.vertices[v]) - to.offset_m) > 2 * flat_as_it_is_m) return false;
  return true;
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
