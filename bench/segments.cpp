// SPDX-License-Identifier: Apache-2.0
// Computes specular reflection in double, and converts back to float32.
// A hit's primitive must be the triangle's index in the array given to next_segment.
#include "segments.hpp"

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace wavetracer::bench {
namespace {

// Moves p off its surface by a distance that float32 resolves: some steps of the last bit, or an absolute distance near
// the origin.
std::array<float, 3> offset_point(glm::dvec3 p, glm::dvec3 normal) {
  std::array<float, 3> out;
  for (int axis = 0; axis < 3; axis++) {
    const auto x = static_cast<float>(p[axis]), n = static_cast<float>(normal[axis]);
    const auto step = static_cast<int32_t>(256.0f * n);
    const float moved = std::bit_cast<float>(std::bit_cast<int32_t>(x) + (x < 0 ? -step : step));
    out[static_cast<size_t>(axis)] = std::abs(x) < 1.0f / 32 ? x + n / 65536 : moved;
  }
  return out;
}

glm::dvec3 point(const float (&v)[3]) { return {v[0], v[1], v[2]}; }
glm::dvec3 point(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

std::vector<Ray> next_segment(std::span<const Ray> rays, std::span<const Hit> hits,
                              std::span<const AccelTriangle> triangles) {
  std::vector<Ray> next;
  for (size_t i = 0; i < rays.size(); i++) {
    if (hits[i].primitive == kNoPrimitive) continue;
    const AccelTriangle& triangle = triangles[hits[i].primitive];
    const glm::dvec3 a = point(triangle.v[0]), d = point(rays[i].direction);
    glm::dvec3 normal = glm::normalize(glm::cross(point(triangle.v[1]) - a, point(triangle.v[2]) - a));
    if (glm::dot(normal, d) > 0) normal = -normal;
    const glm::dvec3 hit = point(rays[i].origin) + static_cast<double>(hits[i].t) * d;
    const glm::dvec3 out = glm::normalize(d - 2 * glm::dot(normal, d) * normal);
    next.push_back({offset_point(hit, normal),
                    0,
                    {static_cast<float>(out.x), static_cast<float>(out.y), static_cast<float>(out.z)},
                    std::numeric_limits<float>::max()});
  }
  return next;
}

}  // namespace wavetracer::bench
