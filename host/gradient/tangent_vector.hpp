// SPDX-License-Identifier: Apache-2.0
// Vectors of tangents under the names of wavetracer/device/vector.h, and its functions of them.
#pragma once
#include "gradient/tangent.hpp"
#include "wavetracer/device/vector.h"

#define WT_DOUBLE2_TANGENT(x, y) (wt_double2{(x), (y)})
#define WT_DOUBLE3_TANGENT(x, y, z) (wt_double3{(x), (y), (z)})

namespace wavetracer::tangent {

struct wt_double2 {
  Tangent x, y;
};
struct wt_double3 {
  Tangent x, y, z;
};

inline wt_double2 operator-(const wt_double2& a) { return {-a.x, -a.y}; }
inline wt_double2 operator+(const wt_double2& a, const wt_double2& b) { return {a.x + b.x, a.y + b.y}; }
inline wt_double2 operator-(const wt_double2& a, const wt_double2& b) { return {a.x - b.x, a.y - b.y}; }
inline wt_double2 operator*(const wt_double2& a, const Tangent& b) { return {a.x * b, a.y * b}; }
inline wt_double2 operator*(const wt_double2& a, double b) { return {a.x * b, a.y * b}; }
inline wt_double2 operator/(const wt_double2& a, const Tangent& b) { return {a.x / b, a.y / b}; }

inline wt_double3 operator-(const wt_double3& a) { return {-a.x, -a.y, -a.z}; }
inline wt_double3 operator+(const wt_double3& a, const wt_double3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline wt_double3 operator-(const wt_double3& a, const wt_double3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline wt_double3 operator*(const wt_double3& a, const Tangent& b) { return {a.x * b, a.y * b, a.z * b}; }
inline wt_double3 operator*(const wt_double3& a, double b) { return {a.x * b, a.y * b, a.z * b}; }
inline wt_double3 operator/(const wt_double3& a, const Tangent& b) { return {a.x / b, a.y / b, a.z / b}; }

inline Tangent wt_dot3(const wt_double3& a, const wt_double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Tangent wt_length3(const wt_double3& a) { return sqrt(wt_dot3(a, a)); }
inline wt_double3 wt_cross3(const wt_double3& a, const wt_double3& b) {
  return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
inline wt_double3 wt_normalized(const wt_double3& a) { return a * (1.0 / wt_length3(a)); }
inline wt_double3 wt_mirrored(const wt_double3& k, const wt_double3& normal) {
  return k - normal * (wt_dot3(normal, k) * 2.0);
}
inline wt_double3 wt_vector(const Tangent* v) { return {v[0], v[1], v[2]}; }
inline wt_double3 wt_vector(const double* v) { return {v[0], v[1], v[2]}; }

}  // namespace wavetracer::tangent
