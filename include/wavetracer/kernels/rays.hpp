// SPDX-License-Identifier: Apache-2.0
// Rays and their hits, as the passes of the suite take them: records of 32 and 16 bytes, one after the other. A kernel
// of your own may write and read them; wavetracer/device/packed_rays.h declares the same records for OpenCL C.
#pragma once
#include <cstdint>
#include <limits>

namespace wavetracer::kernels {

// The number of the triangle that a ray leaves or meets where there is none.
constexpr uint32_t no_triangle = 0xffffffffu;

// A ray meets what lies at origin + t * direction with t_min < t <= t_max. The direction has any length but 0, unless a
// pass asks for unit length; t counts in lengths of the direction.
struct Ray {
  float origin[3];
  float t_min = 0;
  float direction[3];
  float t_max = std::numeric_limits<float>::infinity();
};

// A hit is at origin + t * direction, which is (1 - u - v) * first + u * second + v * third corner of the triangle.
struct Hit {
  float t;            // infinite where nothing is met
  uint32_t triangle;  // no_triangle where nothing is met
  float u, v;         // 0 where nothing is met
  bool missed() const { return triangle == no_triangle; }
};

}  // namespace wavetracer::kernels
