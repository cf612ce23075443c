// SPDX-License-Identifier: Apache-2.0
// Splits polygons into triangles, by fans and by ear clipping (G. Meisters, "Polygons have ears", 1975).
// It works in 3D with Newell's normal as the sign of every turn, so no projection has to be chosen.
#include "scene/polygon.hpp"

#include <glm/geometric.hpp>

namespace wavetracer {
namespace {

using glm::dvec3;

// Returns twice the area vector of a polygon (Newell), which is robust for concave and slightly bent polygons.
dvec3 newell(std::span<const dvec3> vertices, std::span<const uint32_t> polygon) {
  dvec3 sum(0);
  const dvec3 base = vertices[polygon[0]];
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += glm::cross(vertices[polygon[i]] - base, vertices[polygon[i + 1]] - base);
  }
  return sum;
}

// Returns twice the signed area of (a, b, c), seen along normal.
double turn(const dvec3& normal, const dvec3& a, const dvec3& b, const dvec3& c) {
  return glm::dot(normal, glm::cross(b - a, c - a));
}

bool is_convex(std::span<const dvec3> vertices, std::span<const uint32_t> polygon, const dvec3& normal) {
  const size_t n = polygon.size();
  for (size_t i = 0; i < n; ++i) {
    const dvec3 &a = vertices[polygon[i]], &b = vertices[polygon[(i + 1) % n]], &c = vertices[polygon[(i + 2) % n]];
    if (turn(normal, a, b, c) < 0) return false;
  }
  return true;
}

// Tells whether corner i of the polygon can be cut off: it turns left and no other corner lies in its triangle.
bool is_ear(std::span<const dvec3> vertices, std::span<const uint32_t> polygon, const dvec3& normal, size_t i) {
  const size_t n = polygon.size();
  const uint32_t before = polygon[(i + n - 1) % n], at = polygon[i], after = polygon[(i + 1) % n];
  const dvec3 &a = vertices[before], &b = vertices[at], &c = vertices[after];
  if (turn(normal, a, b, c) <= 0) return false;
  for (uint32_t other : polygon) {
    if (other == before || other == at || other == after) continue;
    const dvec3& p = vertices[other];
    if (turn(normal, a, b, p) >= 0 && turn(normal, b, c, p) >= 0 && turn(normal, c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

void triangulate_polygon(std::span<const dvec3> vertices, std::span<const uint32_t> polygon,
                         std::vector<Triangle>& out) {
  std::vector<uint32_t> rest(polygon.begin(), polygon.end());
  const dvec3 normal = newell(vertices, polygon);
  if (rest.size() > 3 && !is_convex(vertices, polygon, normal)) {
    // If no ear is left (a self-touching polygon), the rest becomes a fan.
    for (size_t i = 0; i < rest.size() && rest.size() > 3;) {
      if (!is_ear(vertices, rest, normal, i)) {
        ++i;
        continue;
      }
      const size_t n = rest.size();
      out.push_back({rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]});
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    }
  }
  for (size_t i = 1; i + 1 < rest.size(); ++i) out.push_back({rest[0], rest[i], rest[i + 1]});
}

}  // namespace wavetracer
