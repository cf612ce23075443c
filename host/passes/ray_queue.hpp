// Ray queues and hit lists: planes of 32-bit words, see wavetracer/device/records.h.
// Capacities are padded, so that 16-wide kernels may read and write past the last ray without leaving a plane.
#pragma once
#include <cstdint>

#include "gpu/gpu.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

inline uint32_t padded_capacity(uint64_t rays) { return static_cast<uint32_t>((rays + 255) / 256 * 256 + 256); }

struct RayQueue {
  gpu::Buffer<float> planes;
  uint32_t capacity = 0;
  uint32_t count = 0;
};

struct HitList {
  gpu::Buffer<float> planes;
  uint32_t capacity = 0;
  gpu::Buffer<uint32_t> block_hits;  // hits a block of rays; after scan, hits of all blocks before
};

// samples: with the plane WT_RAY_SAMPLE.
inline RayQueue make_ray_queue(gpu::Context& context, uint64_t rays, const char* name, bool samples = false) {
  const uint32_t capacity = padded_capacity(rays);
  return {context.buffer<float>(size_t{capacity} * (WT_RAY_PLANES + samples), name), capacity, 0};
}

inline HitList make_hit_list(gpu::Context& context, uint64_t rays, uint32_t block) {
  const uint32_t capacity = padded_capacity(rays);
  return {context.buffer<float>(size_t{capacity} * WT_HIT_PLANES, "hits"), capacity,
          context.buffer<uint32_t>(capacity / block + 1, "block counts")};
}

}  // namespace wavetracer
