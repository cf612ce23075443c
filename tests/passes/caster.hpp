// SPDX-License-Identifier: Apache-2.0
// The slow oracle of trace: every triangle against every ray, in double, with no acceleration of any kind.
// It checks answers instead of computing them: float32 rounding decides which of two triangles an edge belongs to.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "accel/triangles.hpp"
#include "passes/triangles.hpp"

namespace wavetracer::test {

// The point where the line of a ray meets a triangle's plane, and how far it passes inside the triangle: the least
// distance from the lines of the edges, negative outside, in metres. It is not_a_number if the ray lies in the plane.
struct Meeting {
  double t, inside_m, t_error;
};

inline Meeting meet(const AccelTriangle& triangle, const Ray& ray, double position_error_m) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  glm::dvec3 v[3];
  for (int i = 0; i < 3; ++i) v[i] = {triangle.v[i][0], triangle.v[i][1], triangle.v[i][2]};
  const glm::dvec3 o = to_double(ray.origin), d = to_double(ray.direction);
  const glm::dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
  const double size = glm::length(normal), along = glm::dot(normal, d);
  if (!(std::abs(along) > 1e-12 * size)) return {nan, nan, nan};
  double inside_m = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 edge = v[(i + 1) % 3] - v[i], across = glm::cross(edge, d);
    const double length = glm::length(across);
    if (!(length > 0)) return {nan, nan, nan};
    const double distance = glm::dot(across, o - v[i]) / length;
    inside_m = std::min(inside_m, along < 0 ? distance : -distance);
  }
  // An error of position moves the crossing along the ray by that error divided by the cosine.
  return {glm::dot(normal, v[0] - o) / along, inside_m, position_error_m * size / std::abs(along)};
}

// Returns a text about an error in the hit of a ray, or an empty one. position_error_m: the largest float32 error of a
// coordinate.
inline std::string fault(std::span<const AccelTriangle> triangles, const Ray& ray, const Hit& hit,
                         double position_error_m) {
  Meeting mine{std::numeric_limits<double>::infinity(), 0, 0};
  if (!hit.missed()) {
    if (hit.primitive >= triangles.size()) return "no such primitive";
    if (triangles[hit.primitive].surface != hit.surface) return "the surface is not the primitive's";
    if (hit.surface == ray.surface) return "it hit the surface that it left";
    mine = meet(triangles[hit.primitive], ray, position_error_m);
    if (std::isnan(mine.t)) return {};  // the ray lies in the plane: any answer is accepted
    if (mine.inside_m < -position_error_m) return "the triangle is passed at " + std::to_string(-mine.inside_m) + " m";
    if (!(hit.t > 0)) return "a hit behind the origin";
    if (std::abs(mine.t - hit.t) > mine.t_error)
      return "distance " + std::to_string(hit.t) + " for " + std::to_string(mine.t);
  }
  for (const AccelTriangle& other : triangles) {
    if (other.primitive == hit.primitive || other.surface == ray.surface) continue;
    const Meeting m = meet(other, ray, position_error_m);
    if (m.inside_m > position_error_m && m.t > m.t_error && m.t + m.t_error < mine.t - mine.t_error)
      return "triangle " + std::to_string(other.primitive) + " at " + std::to_string(m.t) + " is nearer";
  }
  return {};
}

}  // namespace wavetracer::test
