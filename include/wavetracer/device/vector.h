// SPDX-License-Identifier: Apache-2.0
// Vectors of doubles in C++ (GLM) and OpenCL C under one set of names, and functions of them for both.
// They use + - * / and sqrt in a fixed order, so host, CPUs and GPUs agree to the last bit. They assume no contraction.
#ifndef WAVETRACER_DEVICE_VECTOR_H
#define WAVETRACER_DEVICE_VECTOR_H
#include "wavetracer/device/types.h"

#ifdef __OPENCL_VERSION__
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT OFF
#define WT_GLOBAL global
#define WT_NUMBERS constant  // a table of numbers at the top of a file
typedef double2 wt_double2;
typedef double3 wt_double3;
#define WT_DOUBLE2(x, y) ((double2)((x), (y)))
#define WT_DOUBLE3(x, y, z) ((double3)((x), (y), (z)))
#define WT_INFINITY ((double)INFINITY)
#else
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#define WT_GLOBAL
#define WT_NUMBERS inline constexpr
#define WT_DOUBLE2(x, y) (glm::dvec2((x), (y)))
#define WT_DOUBLE3(x, y, z) (glm::dvec3((x), (y), (z)))
#define WT_INFINITY (std::numeric_limits<double>::infinity())
namespace wavetracer::device {
using std::copysign;
using std::fabs;
using std::floor;
using std::fma;
using std::fmax;
using std::fmin;
using std::ldexp;
using std::sqrt;
using wt_double2 = glm::dvec2;
using wt_double3 = glm::dvec3;
#endif

#define WT_PI 3.14159265358979323846

inline double wt_dot3(wt_double3 a, wt_double3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double wt_length3(wt_double3 a) { return sqrt(wt_dot3(a, a)); }
inline wt_double3 wt_cross3(wt_double3 a, wt_double3 b) {
  return WT_DOUBLE3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
}
inline wt_double3 wt_normalized(wt_double3 a) { return a * (1.0 / wt_length3(a)); }
// The direction k after a mirror with this unit normal.
inline wt_double3 wt_mirrored(wt_double3 k, wt_double3 normal) { return k - normal * (wt_dot3(normal, k) * 2.0); }
inline wt_double3 wt_vector(const WT_GLOBAL double* v) { return WT_DOUBLE3(v[0], v[1], v[2]); }

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
