// SPDX-License-Identifier: Apache-2.0
// Buildings of parallelograms for the scenes of the end-to-end tests.
#pragma once
#include <cmath>
#include <vector>

#include "reference/quads.hpp"

namespace wavetracer::test {

// A box of five faces that stands on z = 0, turned about the vertical.
inline std::vector<reference::Quad> building(const glm::dvec3& corner, double turn, double width, double depth,
                                             double height) {
  const glm::dvec3 u{width * std::cos(turn), width * std::sin(turn), 0},
      v{-depth * std::sin(turn), depth * std::cos(turn), 0};
  const glm::dvec3 up{0, 0, height};
  return {{corner, u, up}, {corner + u, v, up}, {corner + v, u, up}, {corner, v, up}, {corner + up, u, v}};
}

}  // namespace wavetracer::test
