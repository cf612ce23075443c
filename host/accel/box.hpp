// SPDX-License-Identifier: Apache-2.0
// An axis-aligned box in float32, and the few operations that building needs.
// Bounds are finite; an empty box is inverted (lower > upper), and growing and intersecting handle that.
#pragma once
#include <algorithm>
#include <limits>

namespace wavetracer {

struct Box {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  float lower[3] = {kInfinity, kInfinity, kInfinity};
  float upper[3] = {-kInfinity, -kInfinity, -kInfinity};

  void grow(const float (&point)[3]) {
    for (int axis = 0; axis < 3; axis++) {
      lower[axis] = std::min(lower[axis], point[axis]);
      upper[axis] = std::max(upper[axis], point[axis]);
    }
  }
  void grow(const Box& other) {
    for (int axis = 0; axis < 3; axis++) {
      lower[axis] = std::min(lower[axis], other.lower[axis]);
      upper[axis] = std::max(upper[axis], other.upper[axis]);
    }
  }
  void clip(const Box& other) {
    for (int axis = 0; axis < 3; axis++) {
      lower[axis] = std::max(lower[axis], other.lower[axis]);
      upper[axis] = std::min(upper[axis], other.upper[axis]);
    }
  }
  bool empty() const { return lower[0] > upper[0] || lower[1] > upper[1] || lower[2] > upper[2]; }
  bool contains(const Box& other) const {
    for (int axis = 0; axis < 3; axis++)
      if (other.lower[axis] < lower[axis] || other.upper[axis] > upper[axis]) return false;
    return true;
  }
  // It computes in double, because extents of float32 overflow or vanish when they are multiplied.
  double extent(int axis) const { return static_cast<double>(upper[axis]) - static_cast<double>(lower[axis]); }
  double center(int axis) const { return 0.5 * (static_cast<double>(upper[axis]) + static_cast<double>(lower[axis])); }
  // Returns half of the surface area, the measure of the surface area heuristic (SAH); zero for an empty box.
  double half_area() const {
    if (empty()) return 0;
    const double x = extent(0), y = extent(1), z = extent(2);
    return x * y + y * z + z * x;
  }
};

}  // namespace wavetracer
