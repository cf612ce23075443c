// SPDX-License-Identifier: Apache-2.0
// Two grids are used: one of surfaces, to find the few that may overlap, and one of the triangles of those.
#include "scene/coplanar_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "scene/convex_cut.hpp"
#include "scene/flat_mesh.hpp"
#include "scene/scene_grid.hpp"
#include "scene/topology.hpp"
#include "scene/triangle_grid.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
constexpr uint32_t no_triangle = 0xFFFFFFFFu;

bool boxes_meet(const SceneBox& a, const SceneBox& b) {
  return glm::all(glm::lessThanEqual(a.lower, b.upper)) && glm::all(glm::lessThanEqual(b.lower, a.upper));
}

bool may_share_a_plane(const Surface& a, const Surface& b) {
  return a.material != b.material && std::abs(glm::dot(a.normal, b.normal)) >= least_cosine;
}

// Marks surfaces that are near a surface of another material and about the same direction.
std::vector<bool> near_surfaces(const Scene& scene) {
  std::vector<bool> out(scene.surfaces.size(), false);
  std::vector<SceneBox> boxes;
  for (const Surface& s : scene.surfaces) boxes.push_back({s.lower - flat_as_it_is_m, s.upper + flat_as_it_is_m});
  const SceneGrid grid(boxes);
  const CellLists lists = lists_of(grid, boxes);
  for (uint32_t cell = 0; cell < grid.size(); ++cell) {
    const std::span<const uint32_t> here = lists[cell];
    for (size_t i = 1; i < here.size(); ++i)
      for (size_t k = 0; k < i; ++k) {
        const uint32_t a = here[i], b = here[k];
        if ((out[a] && out[b]) || !may_share_a_plane(scene.surfaces[a], scene.surfaces[b])) continue;
        if (boxes_meet(boxes[a], boxes[b])) out[a] = out[b] = true;
      }
  }
  return out;
}

bool lie_on_each_other(const Scene& scene, uint32_t t, uint32_t u) {
  const Surface &a = scene.surfaces[scene.triangle_surface[t]], &b = scene.surfaces[scene.triangle_surface[u]];
  if (!may_share_a_plane(a, b)) return false;
  const auto in_plane_of = [&](uint32_t triangle, const Surface& surface) {
    return triangle_is_near(scene, triangle, plane_of(surface), flat_as_it_is_m);
  };
  if (!in_plane_of(t, b) && !in_plane_of(u, a)) return false;
  return overlap_in_plane(scene, t, a.normal, u, b.normal);
}

}  // namespace

std::vector<std::pair<uint32_t, uint32_t>> coplanar_pairs(const Scene& scene) {
  std::vector<std::pair<uint32_t, uint32_t>> out;
  const auto other_material = [&](const Surface& s) { return s.material != scene.surfaces[0].material; };
  if (std::ranges::none_of(scene.surfaces, other_material)) return out;
  const std::vector<bool> near = near_surfaces(scene);
  std::vector<uint32_t> triangles;
  std::vector<SceneBox> boxes;
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    if (!near[scene.triangle_surface[t]]) continue;
    triangles.push_back(t);
    boxes.push_back(triangle_box(scene, t, flat_as_it_is_m));
  }
  if (triangles.empty()) return out;
  const SceneGrid grid(boxes);
  const CellLists lists = lists_of(grid, boxes);
  std::vector<uint32_t> asked_by(triangles.size(), no_triangle);  // a triangle may be in several cells
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    grid.visit_box(boxes[i], [&](uint32_t cell) {
      for (const uint32_t k : lists[cell]) {
        if (k >= i) break;
        if (asked_by[k] == i) continue;
        asked_by[k] = i;
        if (boxes_meet(boxes[i], boxes[k]) && lie_on_each_other(scene, triangles[i], triangles[k]))
          out.emplace_back(triangles[k], triangles[i]);
      }
    });
  }
  std::ranges::sort(out);
  return out;
}

}  // namespace wavetracer
