// SPDX-License-Identifier: Apache-2.0
// The image method again, on parallelograms, without triangles and tolerances, for sequences that a test names. It
// shares no code with kernels/paths/solve.cl; legs are not tested.
#pragma once
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "passes/exact.hpp"
#include "passes/triangles.hpp"
#include "reference/quads.hpp"

namespace wavetracer::test {

using reference::Quad;

inline glm::dvec3 normal_of(const Quad& quad) { return glm::normalize(glm::cross(quad.u, quad.v)); }

// Returns the transmitter and its images, one behind each mirror of the sequence.
inline std::vector<glm::dvec3> images_of(const std::vector<Quad>& quads, const glm::dvec3& from,
                                         const std::vector<uint32_t>& sequence) {
  std::vector<glm::dvec3> images{from};
  for (const uint32_t s : sequence) {
    const glm::dvec3 n = normal_of(quads[s]), at = images.back();
    images.push_back(at - 2 * glm::dot(n, at - quads[s].corner) * n);
  }
  return images;
}

// Returns the reflection points, or nothing if one lies outside its parallelogram or a leg comes through from behind.
inline std::optional<std::vector<glm::dvec3>> image_method(const std::vector<Quad>& quads, const glm::dvec3& from,
                                                           const std::vector<uint32_t>& sequence,
                                                           const glm::dvec3& to) {
  const auto height = [&](uint32_t s, const glm::dvec3& p) {
    return glm::dot(normal_of(quads[s]), p - quads[s].corner);
  };
  const std::vector<glm::dvec3> images = images_of(quads, from, sequence);
  std::vector<glm::dvec3> points(sequence.size());
  glm::dvec3 target = to;
  for (size_t k = sequence.size(); k-- > 0;) {
    const Quad& quad = quads[sequence[k]];
    const double a = height(sequence[k], images[k + 1]), b = height(sequence[k], target);
    if (a * b >= 0) return std::nullopt;
    const glm::dvec3 p = images[k + 1] + (target - images[k + 1]) * (a / (a - b)), at = p - quad.corner;
    // at = s u + t v, solved by Cramer's rule on the normal equations.
    const double uu = glm::dot(quad.u, quad.u), uv = glm::dot(quad.u, quad.v), vv = glm::dot(quad.v, quad.v);
    const double au = glm::dot(at, quad.u), av = glm::dot(at, quad.v), det = uu * vv - uv * uv;
    const double s = (au * vv - av * uv) / det, t = (av * uu - au * uv) / det;
    if (s < 0 || s > 1 || t < 0 || t > 1) return std::nullopt;
    target = points[k] = p;
  }
  for (size_t k = 0; k < sequence.size(); ++k) {
    const glm::dvec3 before = k == 0 ? from : points[k - 1], after = k + 1 == sequence.size() ? to : points[k + 1];
    if (height(sequence[k], before) * height(sequence[k], after) <= 0) return std::nullopt;
  }
  return points;
}

// A wall x = at of 4 m x 4 m around y = z = 0.
inline Quad wall(double at) { return {{at, -2, -2}, {0, 4, 0}, {0, 0, 4}}; }

inline std::vector<Quad> random_quads(size_t count, double extent, double size, Random& random) {
  std::vector<Quad> quads;
  while (quads.size() < count) {
    const Quad quad{random.in_cube(extent), random.in_cube(size), random.in_cube(size)};
    if (glm::length(glm::cross(quad.u, quad.v)) > 0.1 * size * size) quads.push_back(quad);
  }
  return quads;
}

}  // namespace wavetracer::test
