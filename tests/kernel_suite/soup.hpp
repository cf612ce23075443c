// SPDX-License-Identifier: Apache-2.0
// Random triangles and rays, and the nearest hit of a ray among all triangles by the test of T. Möller and B. Trumbore
// (1997) in double. It uses nothing of the suite but its records.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "wavetracer/kernels/rays.hpp"

namespace wavetracer::test {

using Vec = std::array<double, 3>;

inline Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vec vec_of(const float* p) { return {p[0], p[1], p[2]}; }

class Numbers {
 public:
  explicit Numbers(uint32_t seed) : engine_(seed) {}
  float between(double low, double high) {
    return static_cast<float>(low + (high - low) * static_cast<double>(engine_()) * 0x1p-32);
  }
  uint32_t below(uint32_t count) { return static_cast<uint32_t>(uint64_t{engine_()} * count >> 32); }
  std::array<float, 3> unit() {
    for (;;) {
      const Vec v{between(-1, 1), between(-1, 1), between(-1, 1)};
      const double length = std::sqrt(dot(v, v));
      if (length < 0.1 || length > 1) continue;
      return {static_cast<float>(v[0] / length), static_cast<float>(v[1] / length), static_cast<float>(v[2] / length)};
    }
  }

 private:
  std::mt19937 engine_;
};

// Triangles of sides up to some `size`, in a cube of half side `half`; nine floats each.
inline std::vector<float> soup(size_t triangles, double half, double size, uint32_t seed) {
  Numbers numbers(seed);
  std::vector<float> corners;
  for (size_t i = 0; i < triangles; ++i) {
    float centre[3];
    for (float& x : centre) x = numbers.between(-half, half);
    for (int k = 0; k < 9; ++k) corners.push_back(centre[k % 3] + numbers.between(-size, size));
  }
  return corners;
}

inline std::vector<kernels::Ray> rays_in_cube(size_t count, double half, uint32_t seed) {
  Numbers numbers(seed);
  std::vector<kernels::Ray> rays(count);
  for (kernels::Ray& ray : rays) {
    const std::array<float, 3> along = numbers.unit();
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = numbers.between(-half, half);
      ray.direction[axis] = along[static_cast<size_t>(axis)];
    }
  }
  return rays;
}

struct Nearest {
  uint32_t triangle = kernels::no_triangle;
  double t = std::numeric_limits<double>::infinity(), u = 0, v = 0;
  bool certain = true;  // rounding does not decide
};

// left: a triangle that the ray does not meet.
inline Nearest nearest_of(const std::vector<float>& corners, const kernels::Ray& ray,
                          uint32_t left = kernels::no_triangle) {
  constexpr double slack = 1e-4;
  Nearest out;
  double unsure = std::numeric_limits<double>::infinity();
  const Vec d = vec_of(ray.direction);
  for (uint32_t i = 0; i < corners.size() / 9; ++i) {
    if (i == left) continue;
    const float* c = corners.data() + size_t{9} * i;
    const Vec a = vec_of(c), ab = minus(vec_of(c + 3), a), ac = minus(vec_of(c + 6), a), p = cross(d, ac);
    const double det = dot(ab, p);
    if (det == 0) continue;
    const Vec s = minus(vec_of(ray.origin), a), q = cross(s, ab);
    const double u = dot(s, p) / det, v = dot(d, q) / det, t = dot(ac, q) / det;
    const double inside = std::min({u, v, 1 - u - v});
    if (inside < -slack || t < ray.t_min - slack || t > ray.t_max + slack) continue;
    const bool sure = inside > slack && t > ray.t_min + slack && t < ray.t_max - slack;
    if (!sure || std::abs(t - out.t) < slack) unsure = std::min(unsure, t);
    if (sure && t < out.t) {
      out.triangle = i;
      out.t = t;
      out.u = u;
      out.v = v;
    }
  }
  out.certain = unsure > out.t + slack || unsure == std::numeric_limits<double>::infinity();
  return out;
}

// Is a hit not the one that must be found?
inline bool differs(const kernels::Hit& hit, const Nearest& expected, double most = 1e-3) {
  if (hit.triangle != expected.triangle) return true;
  if (hit.missed()) return hit.t != std::numeric_limits<float>::infinity();
  return std::abs(hit.t - expected.t) > most;
}

}  // namespace wavetracer::test
