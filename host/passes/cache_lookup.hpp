// SPDX-License-Identifier: Apache-2.0
// cache_lookup: rays of a queue that the ray cache can answer get their hit; the others are marked for tracing. It
// needs a labelled queue, see label_rays.
#pragma once
#include "kernel_calls/cache_lookup.hpp"
#include "passes/cache_surfaces.hpp"
#include "passes/cache_table.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class CacheLookup {
 public:
  CacheLookup(gpu::Context& context, const CacheTable& table);
  // missed[i] becomes i where ray i is to be traced (bit patterns, as Compact takes them); else it is WT_NONE, and
  // hits[i] is the cached hit. With hit_point = "own" that is the point where the ray meets the plane of the cached
  // surface; a point outside of the surface's bounds counts as a miss. With "cached" the ray itself is replaced by the
  // cached one. static_surfaces: rays that left a surface from this number on do not ask the cache with a quantised key
  // and scope = "static", since these surfaces move. touch: sets table.uses of entries that answer to `now`, for
  // eviction. receptions: needed with scope = "all"; [i] becomes the receiver that an answered segment passes, or
  // WT_NONE. Throws std::invalid_argument where the table asks for something that is null.
  void operator()(const CacheSurfaces& world, RayQueue& rays, HitList& hits, gpu::Buffer<float>& missed,
                  CacheTable& table, const CacheMovement& movement, uint32_t static_surfaces, uint32_t now, bool touch,
                  gpu::Buffer<uint32_t>* receptions = nullptr);

 private:
  Work work_;
  gpu::KernelOf<calls::cache_lookup::cache_lookup> kernel_;
};

}  // namespace wavetracer
