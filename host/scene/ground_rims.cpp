// Sheets by joining surfaces, what is below by lines.
#include "scene/ground_rims.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace wavetracer {
namespace {

using glm::dvec3;

constexpr double flattest_z = std::numbers::sqrt2 / 2;  // of the normal, at 45 degrees
constexpr double inset_m = 0.01;                        // looked down from beside the edge, on its face
constexpr double own_m = 0.02;                          // what is so near below is the sheet itself
constexpr int places = 8;                               // along the edge

double plan_area_m2(const SceneBox& box) { return (box.upper.x - box.lower.x) * (box.upper.y - box.lower.y); }

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

GroundRims::GroundRims(const Scene& scene) : scene_(scene), parent_(scene.surfaces.size()) {
  std::iota(parent_.begin(), parent_.end(), 0u);
  for (const Edge& edge : scene.edges)
    for (uint32_t k = 1; k < edge.face_count; ++k)
      join(scene.triangle_surface[scene.edge_faces[edge.first_face]],
           scene.triangle_surface[scene.edge_faces[edge.first_face + k]]);
}

uint32_t GroundRims::root(uint32_t surface) {
  while (parent_[surface] != surface) surface = parent_[surface] = parent_[parent_[surface]];
  return surface;
}

void GroundRims::join(uint32_t surface, uint32_t other) {
  const uint32_t a = root(surface), b = root(other);
  parent_[std::max(a, b)] = std::min(a, b);
}

void GroundRims::measure() {
  std::vector<SceneBox> sheets;
  for (const Surface& surface : scene_.surfaces) sheets.push_back({surface.lower, surface.upper});
  SceneBox all = sheets[0];
  for (uint32_t s = 0; s < sheets.size(); ++s) {
    all.grow(sheets[s]);
    sheets[root(s)].grow(sheets[s]);
  }
  wide_.resize(sheets.size());
  for (uint32_t s = 0; s < sheets.size(); ++s) wide_[s] = plan_area_m2(sheets[s]) >= 0.5 * plan_area_m2(all);
}

bool GroundRims::are_of(const Wedge& wedge, const TriangleGrid& triangles) {
  if (wedge.surface[0] != wedge.surface[1]) return false;
  if (std::abs(scene_.surfaces[wedge.surface[0]].normal.z) <= flattest_z) return false;
  if (wide_.empty()) measure();
  return wide_[root(wedge.surface[0])] && open_below(wedge, triangles);
}

}  // namespace wavetracer
