// Two grids: one of surfaces, which leaves the few that may overlap, and one of the triangles of those.
#include "scene/coplanar_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "scene/convex_cut.hpp"
#include "scene/flat_mesh.hpp"
#include "scene/scene_grid.hpp"
#include "scene/topology.hpp"
#include "scene/weld.hpp"

namespace wavetracer {
namespace {

using glm::dvec3;
constexpr uint32_t no_triangle = 0xFFFFFFFFu;

bool boxes_meet(const SceneBox& a, const SceneBox& b) {
  return glm::all(glm::lessThanEqual(a.lower, b.upper)) && glm::all(glm::lessThanEqual(b.lower, a.upper));
}

CellLists lists_in(const SceneGrid& grid, const std::vector<SceneBox>& boxes) {
  std::vector<CellLists::Entry> entries;
  for (uint32_t i = 0; i < boxes.size(); ++i)
    grid.visit_box(boxes[i], [&](uint32_t cell) { entries.push_back({cell, i}); });
  return {grid.size(), entries};
}

bool may_share_a_plane(const Surface& a, const Surface& b) {
  return a.material != b.material && std::abs(glm::dot(a.normal, b.normal)) >= least_cosine;
}

// Surfaces that are near one of another material and of about the same direction.
std::vector<bool> near_surfaces(const Scene& scene) {
  std::vector<bool> out(scene.surfaces.size(), false);
  std::vector<SceneBox> boxes;
  for (const Surface& s : scene.surfaces) boxes.push_back({s.lower - flat_as_it_is_m, s.upper + flat_as_it_is_m});
  const SceneGrid grid(boxes);
  const CellLists lists = lists_in(grid, boxes);
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

bool lies_in_plane_of(const Scene& scene, uint32_t t, const Surface& surface) {
  return std::ranges::all_of(scene.triangles[t], [&](uint32_t v) {
    return std::abs(glm::dot(surface.normal, scene.vertices[v]) - surface.offset_m) <= flat_as_it_is_m;
  });
}

// Does a side of t have all of the other triangle outside of it, but for what welding moves?
bool parted_by_side_of(const Scene& scene, uint32_t t, uint32_t other, const dvec3& normal) {
  return std::ranges::any_of(side_lines(scene, t, normal), [&](const CutLine& side) {
    return std::ranges::all_of(scene.triangles[other],
                               [&](uint32_t v) { return side.beyond_m(scene.vertices[v]) <= weld_tolerance_m; });
  });
}

bool lie_on_each_other(const Scene& scene, uint32_t t, uint32_t u) {
  const Surface &a = scene.surfaces[scene.triangle_surface[t]], &b = scene.surfaces[scene.triangle_surface[u]];
  if (!may_share_a_plane(a, b)) return false;
  if (!lies_in_plane_of(scene, t, b) && !lies_in_plane_of(scene, u, a)) return false;
  return !parted_by_side_of(scene, t, u, a.normal) && !parted_by_side_of(scene, u, t, b.normal);
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
    const auto& [a, b, c] = scene.triangles[t];
    const dvec3 &p = scene.vertices[a], &q = scene.vertices[b], &r = scene.vertices[c];
    triangles.push_back(t);
    boxes.push_back({glm::min(glm::min(p, q), r) - flat_as_it_is_m, glm::max(glm::max(p, q), r) + flat_as_it_is_m});
  }
  if (triangles.empty()) return out;
  const SceneGrid grid(boxes);
  const CellLists lists = lists_in(grid, boxes);
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
