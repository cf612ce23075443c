// SPDX-License-Identifier: Apache-2.0
// Computes how coarse the coordinates of a file are.
#include "scene/raw_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace wavetracer {

double float32_rounding(double coordinate) {
  if (!(std::abs(coordinate) > 0) || !std::isfinite(coordinate)) return 0;
  return std::ldexp(1.0, std::ilogb(coordinate) - 24);  // half of a step of 24 binary digits
}

double float32_rounding(std::span<const glm::dvec3> vertices) {
  double reach = 0;
  for (const glm::dvec3& v : vertices) reach = std::max({reach, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return float32_rounding(reach);
}

double largest_stretch(const glm::dmat4& transform) {
  double out = 0;
  for (int k = 0; k < 3; ++k) out = std::max(out, glm::length(glm::dvec3(transform[k])));
  return out;
}

}  // namespace wavetracer
