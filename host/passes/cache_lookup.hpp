// cache_lookup: rays of a queue that the ray cache can answer get their hit; the others are marked for tracing.
// Assumes a labelled queue, see label_rays.
#pragma once
#include "passes/cache_table.hpp"
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class CacheLookup {
 public:
  CacheLookup(gpu::Context& context, const CacheTable& table);
  // missed[i] becomes i where ray i is to be traced, else WT_NONE (bit patterns, as Compact takes them), and hits[i] is
  // the cached one. With hit_point = "own" that is where the ray meets the plane of the cached surface, and a miss
  // where this is outside of the surface's bounds; with "cached" the ray itself is replaced by the cached one.
  // static_surfaces: rays that left a surface from this number on are not asked for with a quantised key and scope =
  // "static", as what they left moves. touch: table.uses of entries that answer becomes `now`, which eviction goes by.
  // receptions: with scope = "all", needed there: [i] becomes the receiver that an answered segment passes, or WT_NONE.
  void operator()(const DeviceScene& scene, RayQueue& rays, HitList& hits, gpu::Buffer<float>& missed,
                  CacheTable& table, const CacheMovement& movement, uint32_t static_surfaces, uint32_t now, bool touch,
                  gpu::Buffer<uint32_t>* receptions = nullptr);

 private:
  Work work_;
  gpu::Kernel kernel_;
};

}  // namespace wavetracer
