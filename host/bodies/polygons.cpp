// SPDX-License-Identifier: Apache-2.0
#include "bodies/polygons.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace wavetracer {

glm::dvec3 area_vector(const Polygon& polygon) {
  glm::dvec3 sum(0);
  for (size_t i = 2; i < polygon.size(); ++i) sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return sum * 0.5;
}

Plane plane_of(const Polygon& polygon) {
  const glm::dvec3 normal = glm::normalize(area_vector(polygon));
  return {normal, glm::dot(normal, polygon[0])};
}

glm::dvec3 centroid(const Polygon& polygon) {
  const glm::dvec3 area = area_vector(polygon);
  glm::dvec3 sum(0);
  for (size_t i = 2; i < polygon.size(); ++i) {
    const glm::dvec3 a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
    sum += (a + b) * glm::dot(glm::cross(a, b), area);
  }
  return polygon[0] + sum / (6.0 * glm::dot(area, area));
}

Polygon part_above(const Polygon& polygon, const Plane& plane, double tolerance_m) {
  Polygon out;
  bool some = false;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 p = polygon[i], next = polygon[(i + 1) % polygon.size()];
    const double here = height_over(plane, p), there = height_over(plane, next);
    some = some || here > tolerance_m;
    if (here >= -tolerance_m) out.push_back(p);
    if ((here > tolerance_m && there < -tolerance_m) || (here < -tolerance_m && there > tolerance_m))
      out.push_back(p + (next - p) * (here / (here - there)));
  }
  return some && out.size() >= 3 ? out : Polygon{};
}

std::vector<Plane> pyramid(glm::dvec3 source, const Polygon& polygon, double tolerance_m) {
  const Plane base = plane_of(polygon);
  const double height = height_over(base, source);
  std::vector<Plane> planes;
  if (std::abs(height) <= tolerance_m) return planes;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const glm::dvec3 across = glm::cross(polygon[i] - source, edge) * (height > 0 ? -1.0 : 1.0);
    const double length = glm::length(across);
    if (length == 0) continue;                                                   // two corners in one place
    planes.push_back({across / length, glm::dot(across, polygon[i]) / length});  // the source may be far away
  }
  return planes;
}

namespace {

// Appends what is left of the polygon. It is not cut if nothing of it is inside.
void append_rest(std::vector<Polygon>& out, const Polygon& polygon, const std::vector<Plane>& planes,
                 double tolerance_m) {
  Polygon inside = polygon;
  std::vector<Polygon> outside;
  for (const Plane& plane : planes) {
    Polygon cut = part_above(inside, flipped(plane), tolerance_m);
    inside = part_above(inside, plane, tolerance_m);
    if (inside.empty()) {
      out.push_back(polygon);
      return;
    }
    if (!cut.empty()) outside.push_back(std::move(cut));
  }
  for (Polygon& part : outside) out.push_back(std::move(part));
}

}  // namespace

void subtract(std::vector<Polygon>& polygons, const std::vector<Plane>& planes, double tolerance_m) {
  if (planes.empty()) return;
  std::vector<Polygon> left;
  for (const Polygon& polygon : polygons) append_rest(left, polygon, planes, tolerance_m);
  polygons = std::move(left);
}

}  // namespace wavetracer
