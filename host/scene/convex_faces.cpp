// SPDX-License-Identifier: Apache-2.0
// A surface is convex without holes if its triangles do not overlap and fill the hull of their corners.
#include "scene/convex_faces.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>

namespace wavetracer {
namespace {

using Triangle2 = std::array<glm::dvec2, 3>;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

double area(const Triangle2& t) { return 0.5 * std::abs(cross(t[1] - t[0], t[2] - t[0])); }

// Tells whether two triangles overlap by more than a border. Two convex polygons are apart if a side of one of them
// separates them.
bool overlap(const Triangle2& a, const Triangle2& b, double tolerance_m) {
  const auto apart = [&](const Triangle2& s, const Triangle2& t) {
    for (int i = 0; i < 3; ++i) {
      const glm::dvec2 side = s[(i + 1) % 3] - s[i];
      const double length = glm::length(side), third = cross(side, s[(i + 2) % 3] - s[i]);
      const double sign = third < 0 ? -1 : 1;
      const auto beyond = [&](const glm::dvec2& p) { return sign * cross(side, p - s[i]) <= tolerance_m * length; };
      if (std::ranges::all_of(t, beyond)) return true;
    }
    return false;
  };
  return !apart(a, b) && !apart(b, a);
}

// Returns the corners of the convex hull, counter-clockwise, without points on its sides (A. M. Andrew's monotone
// chain, 1979).
std::vector<glm::dvec2> hull(std::vector<glm::dvec2> points, double tolerance_m) {
  std::ranges::sort(points, [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::dvec2> out;
  const auto half = [&](auto begin, auto end) {
    const size_t first = out.size();
    for (auto p = begin; p != end; ++p) {
      while (out.size() >= first + 2 && cross(out.back() - out[out.size() - 2], *p - out[out.size() - 2]) <=
                                            tolerance_m * glm::length(*p - out[out.size() - 2]))
        out.pop_back();
      out.push_back(*p);
    }
    out.pop_back();
  };
  half(points.begin(), points.end());
  half(points.rbegin(), points.rend());
  return out;
}

// Returns the sides of one surface, or none if it is not convex.
std::vector<glm::dvec4> sides_of(const Scene& scene, const Surface& surface) {
  constexpr double tolerance_m = 1e-6;
  // A limit of the time, since each pair of triangles is compared.
  constexpr uint32_t max_triangles = 4 * max_face_sides;
  if (surface.triangle_count == 0 || surface.triangle_count > max_triangles) return {};
  const glm::dvec3 n = surface.normal;
  const glm::dvec3 x = glm::normalize(glm::cross(n, std::abs(n.z) < 0.9 ? glm::dvec3{0, 0, 1} : glm::dvec3{1, 0, 0}));
  const glm::dvec3 y = glm::cross(n, x);
  std::vector<Triangle2> triangles;
  std::vector<glm::dvec2> points;
  for (uint32_t k = 0; k < surface.triangle_count; ++k) {
    Triangle2& t = triangles.emplace_back();
    const auto& corners = scene.triangles[scene.surface_triangles[surface.first_triangle + k]];
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3& p = scene.vertices[corners[i]];
      t[i] = {glm::dot(x, p), glm::dot(y, p)};
      points.push_back(t[i]);
    }
  }
  for (size_t i = 0; i < triangles.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (overlap(triangles[i], triangles[j], tolerance_m)) return {};

  const std::vector<glm::dvec2> corners = hull(points, tolerance_m);
  if (corners.size() < 3 || corners.size() > max_face_sides) return {};
  double round = 0, inside = 0;
  std::vector<glm::dvec4> out;
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2& p = corners[i];
    const glm::dvec2& q = corners[(i + 1) % corners.size()];
    inside += 0.5 * cross(p - corners[0], q - corners[0]);
    round += glm::length(q - p);
    const glm::dvec2 inward = glm::dvec2{p.y - q.y, q.x - p.x} / glm::length(q - p);
    out.emplace_back(inward.x * x + inward.y * y, glm::dot(inward, p));
  }
  double filled = 0;
  for (const Triangle2& t : triangles) filled += area(t);
  // The missing area, spread along the border, must be thinner than rounding.
  return std::abs(inside - filled) <= 4 * tolerance_m * round ? out : std::vector<glm::dvec4>{};
}

}  // namespace

ConvexFaces convex_faces(const Scene& scene) {
  ConvexFaces out{{0}, {}};
  for (const Surface& surface : scene.surfaces) {
    const std::vector<glm::dvec4> sides = sides_of(scene, surface);
    out.sides.insert(out.sides.end(), sides.begin(), sides.end());
    out.first.push_back(static_cast<uint32_t>(out.sides.size()));
  }
  return out;
}

}  // namespace wavetracer
