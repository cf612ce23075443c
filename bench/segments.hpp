// SPDX-License-Identifier: Apache-2.0
// The rays of the trace benchmark: directions from one transmitter, then specular bounces of the rays that hit
// something. Coordinates are float32 around the scene's origin; every tracer gets the same arrays.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/triangles.hpp"

namespace wavetracer::bench {

// Has 32 bytes, in the order in which kernels read it as two float4.
struct Ray {
  std::array<float, 3> origin;
  float t_min;
  std::array<float, 3> direction;
  float t_max;
};

constexpr uint32_t kNoPrimitive = ~0u;
struct Hit {
  float t;             // t_max of the ray if it hits nothing
  uint32_t primitive;  // kNoPrimitive if it hits nothing
};

// Returns the reflections of the rays that hit, in the same order (stable compaction). The new origins are moved off
// the plane of the triangle so that no ray hits its own (Waechter and Binder, Ray Tracing Gems, chapter 6).
std::vector<Ray> next_segment(std::span<const Ray> rays, std::span<const Hit> hits,
                              std::span<const AccelTriangle> triangles);

}  // namespace wavetracer::bench
