// SPDX-License-Identifier: Apache-2.0
// Sorts boxes into the grid and follows lines through it.
#include "scene/triangle_grid.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

namespace wavetracer {
namespace {

using glm::dvec3;

constexpr double line_reach_m = 1e-6;  // reach of a line, so that rounding at a border of cells loses no triangle
// Tolerance at a triangle's side, so that rounding opens no gap between two triangles; 1 nm for triangles of a
// kilometre.
constexpr double side_tolerance = 1e-12;

std::vector<SceneBox> boxes_of(const Scene& scene, double reach_m) {
  std::vector<SceneBox> out;
  out.reserve(scene.triangles.size());
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) out.push_back(triangle_box(scene, t, reach_m));
  return out;
}

SceneBox bounds_of(std::span<const SceneBox> boxes) {
  if (boxes.empty()) return {dvec3(0), dvec3(0)};
  SceneBox out = boxes[0];
  for (const SceneBox& box : boxes) out.grow(box);
  return out;
}

// Returns where the line a + t way meets a triangle (T. Moeller and B. Trumbore, J. Graphics Tools 2(1), 1997).
std::optional<double> meets(const dvec3& a, const dvec3& way, const dvec3& v0, const dvec3& v1, const dvec3& v2) {
  const dvec3 e1 = v1 - v0, e2 = v2 - v0, p = glm::cross(way, e2);
  const double det = glm::dot(e1, p);
  if (det == 0) return {};
  const dvec3 s = a - v0, q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / det, v = glm::dot(way, q) / det, t = glm::dot(e2, q) / det;
  if (!(u >= -side_tolerance && v >= -side_tolerance && u + v <= 1 + side_tolerance && t >= 0 && t <= 1)) return {};
  return t;
}

// Returns the part of the line a + t way, 0 <= t <= 1, that may be in the box; empty (first > second) if there is none.
std::pair<double, double> part_within(const SceneBox& box, const dvec3& a, const dvec3& way) {
  double first = 0, second = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.lower[axis] - line_reach_m - a[axis], high = box.upper[axis] + line_reach_m - a[axis];
    if (way[axis] == 0) {
      if (low > 0 || high < 0) return {1, 0};
      continue;
    }
    first = std::max(first, std::min(low / way[axis], high / way[axis]));
    second = std::min(second, std::max(low / way[axis], high / way[axis]));
  }
  return {first, second};
}

}  // namespace

SceneBox triangle_box(const Scene& scene, uint32_t t, double reach_m) {
  const auto& [a, b, c] = scene.triangles[t];
  const dvec3 &p = scene.vertices[a], &q = scene.vertices[b], &r = scene.vertices[c];
  return {glm::min(glm::min(p, q), r) - reach_m, glm::max(glm::max(p, q), r) + reach_m};
}

TriangleGrid::TriangleGrid(const Scene& scene, double reach_m)
    : scene_(scene),
      boxes_(boxes_of(scene, reach_m)),
      bounds_(bounds_of(boxes_)),
      grid_(boxes_),
      triangles_(lists_of(grid_, boxes_)) {}

std::vector<TriangleGrid::Crossing> TriangleGrid::crossings(const dvec3& a, const dvec3& b) const {
  std::vector<Crossing> out;
  const dvec3 way = b - a;
  const auto [first, second] = part_within(bounds_, a, way);
  if (!(first <= second)) return out;
  const double length_m = glm::length(way);
  grid_.visit_line(a + first * way, a + second * way, line_reach_m, [&](uint32_t cell) {
    for (const uint32_t t : triangles_[cell]) {
      const auto& [i, j, k] = scene_.triangles[t];
      if (const auto at = meets(a, way, scene_.vertices[i], scene_.vertices[j], scene_.vertices[k]))
        out.push_back({*at * length_m, t});
    }
  });
  std::ranges::sort(out, {}, [](const Crossing& c) { return std::pair(c.distance_m, c.triangle); });
  const auto repeated = std::ranges::unique(out, {}, &Crossing::triangle);  // a triangle may be in several cells
  out.erase(repeated.begin(), repeated.end());
  return out;
}

}  // namespace wavetracer
