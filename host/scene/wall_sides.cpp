// SPDX-License-Identifier: Apache-2.0
// Normals of surfaces are canonical (plane_fit.hpp), so they say nothing about sides.
#include "scene/wall_sides.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "scene/body_sides.hpp"

namespace wavetracer {
namespace {

// Twice the area of the triangles that are counter-clockwise seen from above the surface, less that of the others.
double turning_area_m2(const Scene& scene, const Surface& surface) {
  double sum = 0;
  for (uint32_t k = 0; k < surface.triangle_count; ++k) {
    const auto& [a, b, c] = scene.triangles[scene.surface_triangles[surface.first_triangle + k]];
    const glm::dvec3 u = scene.vertices[b] - scene.vertices[a], v = scene.vertices[c] - scene.vertices[a];
    sum += glm::dot(glm::cross(u, v), surface.normal);
  }
  return sum;
}

}  // namespace

void find_outer_sides(Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges) {
  const auto has_layers = [](const Material& material) { return !material.layers.empty(); };
  if (std::ranges::none_of(scene.materials, has_layers)) return;
  BodySides bodies(scene, triangle_edges);
  for (uint32_t i = 0; i < scene.surfaces.size(); ++i) {
    Surface& surface = scene.surfaces[i];
    if (!has_layers(scene.materials[surface.material])) continue;
    const int body = bodies.side(i);
    surface.outer_is_below = body != 0 ? body > 0 : turning_area_m2(scene, surface) < 0;
  }
}

}  // namespace wavetracer
