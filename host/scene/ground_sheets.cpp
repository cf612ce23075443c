// SPDX-License-Identifier: Apache-2.0
// Sheets are found by joining surfaces; lines downwards find what lies below a rim.
#include "scene/ground_sheets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/triangle_grid.hpp"

namespace wavetracer {
namespace {

constexpr double flattest_z = std::numbers::sqrt2 / 2;  // z of the normal at 45 degrees

using glm::dvec3;

constexpr double inset_m = 0.01;  // the line downwards starts on the face, this far beside the edge
constexpr double own_m = 0.02;    // a hit nearer than this is the sheet itself
constexpr int places = 8;         // number of places along the edge

bool open_below(const Wedge& wedge, const TriangleGrid& triangles) {
  const double bottom_m = triangles.bounds().lower.z - 1;
  for (int k = 0; k < places; ++k) {
    const dvec3 p = wedge.start + wedge.along * (wedge.length_m * (k + 0.5) / places) + wedge.face * inset_m;
    const auto below = triangles.crossings(p - dvec3(0, 0, own_m), {p.x, p.y, bottom_m});
    if (below.empty()) return true;
  }
  return false;
}

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

GroundRims::GroundRims(const Scene& scene) : scene_(scene), sheets_(scene) {}

void GroundRims::join(uint32_t surface, uint32_t other) { sheets_.join(surface, other); }

bool GroundRims::are_of(const Wedge& wedge, const TriangleGrid& triangles) {
  if (wedge.surface[0] != wedge.surface[1]) return false;
  if (!is_flat(scene_.surfaces[wedge.surface[0]])) return false;
  if (wide_.empty()) wide_ = sheets_.wide();
  return wide_[sheets_.root(wedge.surface[0])] && open_below(wedge, triangles);
}

}  // namespace wavetracer
