// SPDX-License-Identifier: Apache-2.0
// cache_store: puts traced hits into the ray cache, and back into the hits of the whole queue. It needs labelled
// queues, see label_rays.
#pragma once
#include "kernel_calls/cache_store.hpp"
#include "passes/cache_table.hpp"
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class CacheStore {
 public:
  CacheStore(gpu::Context& context, const CacheTable& table);
  // scene: only tables as printed need it, for the instances of its surfaces. Ray k of `missed` is ray indices[k] of
  // the queue whose hits are `hits`. static_surfaces: rays that left a surface from this number on are not stored with
  // a quantised key and scope = "static", since these surfaces move. These two are needed with scope = "all":
  // receptions has, for each missed ray, the first receiver that it passed, or WT_NONE; receivers gets the same for the
  // whole queue.
  void operator()(const DeviceScene& scene, RayQueue& rays, const RayQueue& missed, const HitList& missed_hits,
                  const gpu::Buffer<uint32_t>& indices, HitList& hits, CacheTable& table, uint32_t static_surfaces,
                  uint32_t now, const gpu::Buffer<uint32_t>* receptions = nullptr,
                  gpu::Buffer<uint32_t>* receivers = nullptr);

 private:
  Work work_;
  gpu::KernelOf<calls::cache_store::cache_store> kernel_;
};

}  // namespace wavetracer
