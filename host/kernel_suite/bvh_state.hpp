// SPDX-License-Identifier: Apache-2.0
// The private half of Bvh, which RayCache reads, too.
#pragma once
#include <fmt/format.h>

#include <optional>
#include <span>

#include "kernel_suite/state.hpp"
#include "passes/pack_rays.hpp"
#include "passes/trace.hpp"
#include "passes/trace_rays.hpp"
#include "wavetracer/kernels/bvh.hpp"

namespace wavetracer::kernels {

static_assert(sizeof(Ray) == sizeof(wt_packed_ray) && sizeof(Hit) == sizeof(wt_packed_hit));
static_assert(no_triangle == WT_NONE);

// Packets go through planes of rays.
struct RayPackets {
  RayPackets(gpu::Context& context, const DeviceTrees& trees)
      : pack(context), trace(context, trees, TraceShape::packet16) {}
  PackRays pack;
  Trace trace;
  RayQueue queue;
  HitList hits;
};

struct Bvh::State : PassState {
  State(const Context& of, std::span<const float> corners, const BvhOptions& options);
  DeviceTrees trees;
  gpu::Buffer<float> corners;
  TraceRays trace;
  std::optional<RayPackets> packets;  // made at their first use
};

// A number of rays as queues take it. Throws Error above 2^31, since queues are padded.
inline uint32_t rays_count(const char* pass, size_t n) {
  constexpr size_t most = size_t{1} << 31;
  if (n > most) refuse(pass, fmt::format("{} rays: at most {} at a time", n, most));
  return static_cast<uint32_t>(n);
}

// A public buffer of rays or hits as that of a pass, with room for `least`.
inline gpu::Buffer<wt_packed_ray> rays_of(const PassState& state, const char* pass, const char* argument,
                                          const Buffer<Ray>& rays, size_t least) {
  return gpu::Buffer<wt_packed_ray>(memory_of(state, pass, argument, rays, least * sizeof(Ray)));
}
inline gpu::Buffer<wt_packed_hit> hits_of(const PassState& state, const char* pass, const char* argument,
                                          const Buffer<Hit>& hits, size_t least) {
  return gpu::Buffer<wt_packed_hit>(memory_of(state, pass, argument, hits, least * sizeof(Hit)));
}

}  // namespace wavetracer::kernels
