// SPDX-License-Identifier: Apache-2.0
// Candidates come from a grid over the triangles. Two triangles of one plane overlap if no side of either separates
// them.
#include "scene/earlier_faces.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "scene/convex_cut.hpp"
#include "scene/topology.hpp"
#include "scene/triangle_grid.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;

dvec3 normal_of(const Scene& scene, uint32_t t) { return triangle_shape(scene, t).normal; }

bool overlap(const Scene& scene, uint32_t t, uint32_t other) {
  const dvec3 normal = normal_of(scene, t);
  const Plane plane{normal, glm::dot(normal, scene.vertices[scene.triangles[t][0]])};
  return triangle_is_near(scene, other, plane, flat_as_it_is_m) &&
         overlap_in_plane(scene, t, normal, other, normal_of(scene, other));
}

std::vector<bool> scattering_triangles(const Scene& scene) {
  std::vector<bool> out(scene.triangles.size());
  for (const Surface& surface : scene.surfaces)
    for (uint32_t k = 0; k < surface.triangle_count; ++k)
      out[scene.surface_triangles[surface.first_triangle + k]] = scene.materials[surface.material].scattering > 0;
  return out;
}

}  // namespace

EarlierFaces::EarlierFaces(const Scene& scene) : scene_(scene), below_(scene.triangles.size()) {
  const std::vector<bool> scatters = scattering_triangles(scene);
  if (std::ranges::none_of(scatters, [](bool one) { return one; })) return;
  const TriangleGrid grid(scene);
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (!scatters[t]) continue;
    std::vector<uint32_t>& below = below_[t];
    grid.grid().visit_box(grid.boxes()[t], [&](uint32_t cell) {
      for (const uint32_t other : grid[cell])
        if (other < t && scatters[other] && std::ranges::find(below, other) == below.end() && overlap(scene, t, other))
          below.push_back(other);
    });
  }
}

bool EarlierFaces::hold(uint32_t triangle, const dvec3& point) const {
  constexpr double rounding_m = 1e-9;
  return std::ranges::any_of(below_[triangle], [&](uint32_t other) {
    return std::ranges::all_of(side_lines(scene_, other, normal_of(scene_, other)),
                               [&](const CutLine& side) { return side.beyond_m(point) >= -rounding_m; });
  });
}

uint64_t EarlierFaces::count() const {
  return static_cast<uint64_t>(std::ranges::count_if(below_, [](const auto& list) { return !list.empty(); }));
}

}  // namespace wavetracer
