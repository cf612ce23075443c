// cache_store: what was traced goes into the ray cache, and back to the hits of the whole queue.
// Assumes labelled queues, see label_rays.
#pragma once
#include "passes/cache_table.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class CacheStore {
 public:
  CacheStore(gpu::Context& context, const CacheTable& table);
  // Ray k of `missed` is ray indices[k] of the queue whose hits are `hits`. static_surfaces: rays that left a surface
  // from this number on are not stored with a quantised key and scope = "static", as what they left moves.
  // With scope = "all", needed there: receptions, of the missed rays, the first receiver that each passed, or WT_NONE;
  // receivers, of the whole queue, which become the same.
  void operator()(RayQueue& rays, const RayQueue& missed, const HitList& missed_hits,
                  const gpu::Buffer<uint32_t>& indices, HitList& hits, CacheTable& table, uint32_t static_surfaces,
                  uint32_t now, const gpu::Buffer<uint32_t>* receptions = nullptr,
                  gpu::Buffer<uint32_t>* receivers = nullptr);

 private:
  Work work_;
  gpu::Kernel kernel_;
};

}  // namespace wavetracer
