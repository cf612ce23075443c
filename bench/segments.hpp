// The rays of the trace benchmark: directions from one transmitter, then specular bounces of the rays that hit
// something. Assumes float32 coordinates around the scene's origin; the same arrays are given to every tracer that is
// compared.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/triangles.hpp"

namespace wavetracer::bench {

// 32 bytes, in the order in which kernels read it as two float4.
struct Ray {
  std::array<float, 3> origin;
  float t_min;
  std::array<float, 3> direction;
  float t_max;
};

constexpr uint32_t kNoPrimitive = ~0u;
struct Hit {
  float t;             // t_max of the ray where it hits nothing
  uint32_t primitive;  // kNoPrimitive where it hits nothing
};

// The reflections of the rays that hit, in the same order (stable compaction). The new origins are moved off the plane
// of the triangle so that no ray meets its own (Waechter and Binder, Ray Tracing Gems, chapter 6).
std::vector<Ray> next_segment(std::span<const Ray> rays, std::span<const Hit> hits,
                              std::span<const AccelTriangle> triangles);

}  // namespace wavetracer::bench
