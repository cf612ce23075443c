// SPDX-License-Identifier: Apache-2.0
// Ray queues and hit lists: planes of 32-bit words, see wavetracer/device/records.h.
// Capacities are padded, so that 16-wide kernels may read and write past the last ray without leaving a plane.
#pragma once
#include <cstdint>

#include "gpu/gpu.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/records.h"

namespace wavetracer {

inline uint32_t padded_capacity(uint64_t rays) { return static_cast<uint32_t>((rays + 255) / 256 * 256 + 256); }

struct RayQueue {
  gpu::Buffer<float> planes;
  uint32_t capacity = 0;
  uint32_t count = 0;
  uint32_t plane_count = WT_RAY_PLANES;
};

struct HitList {
  gpu::Buffer<float> planes;
  uint32_t capacity = 0;
  gpu::Buffer<uint32_t> block_hits;  // hits of each block of rays; after the scan, hits of all blocks before it
  uint32_t block = 0;                // rays per block

  uint32_t blocks(uint32_t rays) const { return (rays + block - 1) / block; }
};

// plane_count: WT_RAY_PLANES, one more for WT_RAY_SAMPLE, or WT_RAY_LABELLED_PLANES.
inline RayQueue make_ray_queue(gpu::Context& context, uint64_t rays, const char* name,
                               uint32_t plane_count = WT_RAY_PLANES) {
  const uint32_t capacity = padded_capacity(rays);
  return {context.buffer<float>(size_t{capacity} * plane_count, name), capacity, 0, plane_count};
}

inline HitList make_hit_list(gpu::Context& context, uint64_t rays) {
  const uint32_t capacity = padded_capacity(rays), block = tuning_of(context.info()).block;
  return {context.buffer<float>(size_t{capacity} * WT_HIT_PLANES, "hits"), capacity,
          context.buffer<uint32_t>(capacity / block + 1, "block counts"), block};
}

}  // namespace wavetracer
