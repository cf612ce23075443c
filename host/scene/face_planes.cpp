// SPDX-License-Identifier: Apache-2.0
// A union-find forest over both sides of all surfaces.
#include "scene/face_planes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/topology.hpp"

namespace wavetracer {

using glm::dvec3;

FacePlanes::FacePlanes(const Scene& scene) : scene_(scene), sides_(2 * scene.surfaces.size()) {
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
  const uint32_t a = side(surface, front), b = side(other, front);
  if (sides_.root(a) != sides_.root(b) && in_one_plane(surface, other, at)) sides_.join(a, b);
}

bool FacePlanes::in_one_plane(uint32_t surface, uint32_t other, const dvec3& at) {
  const Surface &a = scene_.surfaces[surface], &b = scene_.surfaces[other];
  if (same_plane(a, b, at)) return true;
  const auto pair = std::minmax(surface, other);
  if (apart_.contains(pair)) return false;
  constexpr double near_m = 2 * flat_as_it_is_m;
  if (surface_is_near(scene_, a, plane_of(b), near_m) && surface_is_near(scene_, b, plane_of(a), near_m)) return true;
  apart_.insert(pair);
  return false;
}

void FacePlanes::number(std::span<Wedge> wedges) {
  for (Wedge& wedge : wedges) {
    const dvec3 last = wedge.face * std::sin(wedge.exterior_rad) - wedge.normal * std::cos(wedge.exterior_rad);
    wedge.plane = {sides_.root(side(wedge.surface[0], wedge.normal)) / 2,
                   sides_.root(side(wedge.surface[1], last)) / 2};
  }
}

uint32_t FacePlanes::side(uint32_t surface, const dvec3& front) const {
  return 2 * surface + (glm::dot(scene_.surfaces[surface].normal, front) < 0);
}

}  // namespace wavetracer
