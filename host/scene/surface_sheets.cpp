// SPDX-License-Identifier: Apache-2.0
#include "scene/surface_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/triangle_grid.hpp"

namespace wavetracer {
namespace {

constexpr double flattest_z = std::numbers::sqrt2 / 2;  // z of the normal at 45 degrees

}  // namespace

SurfaceSheets::SurfaceSheets(const Scene& scene, bool flat_alone) : scene_(scene), sheets_(scene.surfaces.size()) {
  for (const Edge& edge : scene.edges)
    for (uint32_t k = 1; k < edge.face_count; ++k) {
      const uint32_t a = scene.triangle_surface[scene.edge_faces[edge.first_face]],
                     b = scene.triangle_surface[scene.edge_faces[edge.first_face + k]];
      if (!flat_alone || (is_flat(scene.surfaces[a]) && is_flat(scene.surfaces[b]))) join(a, b);
    }
}

std::vector<bool> SurfaceSheets::wide() {
  if (scene_.surfaces.empty()) return {};
  std::vector<SceneBox> sheets;
  for (const Surface& surface : scene_.surfaces) sheets.push_back({surface.lower, surface.upper});
  SceneBox all = sheets[0];
  for (uint32_t s = 0; s < sheets.size(); ++s) {
    all.grow(sheets[s]);
    sheets[root(s)].grow(sheets[s]);
  }
  std::vector<bool> out(sheets.size());
  for (uint32_t s = 0; s < sheets.size(); ++s) out[s] = sheets[s].plan_area_m2() >= 0.5 * all.plan_area_m2();
  return out;
}

bool is_flat(const Surface& surface) { return std::abs(surface.normal.z) > flattest_z; }

size_t ground_surfaces(const Scene& scene) {
  SurfaceSheets sheets(scene, true);
  const std::vector<bool> wide = sheets.wide();
  std::vector<size_t> counts(scene.surfaces.size());
  for (uint32_t s = 0; s < scene.surfaces.size(); ++s)
    if (is_flat(scene.surfaces[s]) && wide[sheets.root(s)]) ++counts[sheets.root(s)];
  return counts.empty() ? 0 : std::ranges::max(counts);
}

}  // namespace wavetracer
