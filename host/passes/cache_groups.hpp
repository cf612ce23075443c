// SPDX-License-Identifier: Apache-2.0
// cache_groups: the rays of one key that the ray cache did not answer are a group, of which one ray is traced. It needs
// a labelled queue, see label_rays, and room for it.
#pragma once
#include "kernel_calls/cache_groups.hpp"
#include "passes/cache_surfaces.hpp"
#include "passes/cache_table.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class CacheGroups {
 public:
  CacheGroups(gpu::Context& context, const CacheTable& table);
  // Makes room for queues of this capacity.
  void reserve(uint32_t capacity);
  // missed: as CacheLookup leaves it, with missed_count rays to be traced. missed[i] stays i for the first ray of each
  // group in the queue, and for rays that the cache does not serve; it becomes WT_NONE for those that follow. Every
  // device chooses the same rays. static_surfaces: as CacheLookup takes it.
  void elect(const RayQueue& rays, gpu::Buffer<float>& missed, uint32_t missed_count, const CacheTable& table,
             uint32_t static_surfaces);
  // Call this after elect(), once the hits of the first rays are known: those that follow get the same hits, by the
  // rules of a look-up (hit_point, precision). refused[i], and missed[i], become i for those that must be traced
  // themselves; all others have WT_NONE in refused[i]. world: as CacheLookup takes it. now: the frame. receivers:
  // needed with scope = "all"; [i] becomes the receiver of the first ray.
  void share(const CacheSurfaces& world, RayQueue& rays, HitList& hits, gpu::Buffer<float>& missed,
             gpu::Buffer<float>& refused, CacheTable& table, uint32_t now, gpu::Buffer<uint32_t>* receivers = nullptr);
  // After elect(): the ray that each ray follows, WT_NONE where it follows none.
  const gpu::Buffer<uint32_t>& representatives() const { return representatives_; }

 private:
  gpu::Context& context_;
  Work work_;
  uint32_t words_;  // words of a key, WT_GROUP_WORDS
  gpu::KernelOf<calls::cache_groups::cache_keys> keys_;
  gpu::KernelOf<calls::cache_groups::cache_elect> elect_;
  gpu::KernelOf<calls::cache_groups::cache_follow> follow_;
  gpu::KernelOf<calls::cache_groups::cache_share> share_;
  gpu::Buffer<uint64_t> key_words_;
  gpu::Buffer<uint32_t> numbers_, representatives_;  // numbers of rays, by the places of their keys
};

}  // namespace wavetracer
