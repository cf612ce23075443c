// cache_groups: rays of one key, of those that the ray cache did not answer, are a group, of which one ray is traced.
// Assumes a labelled queue, see label_rays, and room for it.
#pragma once
#include "passes/cache_table.hpp"
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class CacheGroups {
 public:
  CacheGroups(gpu::Context& context, const CacheTable& table);
  // Makes room for queues of this capacity.
  void reserve(uint32_t capacity);
  // missed: as CacheLookup leaves it, with missed_count rays to be traced. missed[i] stays i for the first ray of each
  // group in the queue, and for rays that the cache is not for; it becomes WT_NONE for those that follow it. What is
  // chosen does not depend on the device. static_surfaces: as CacheLookup takes it.
  void elect(const RayQueue& rays, gpu::Buffer<float>& missed, uint32_t missed_count, const CacheTable& table,
             uint32_t static_surfaces);
  // After elect(), once the hits of the first rays are known: hits of those that follow become the same, by the rules
  // of a look-up (hit_point, precision). refused[i], and missed[i], become i for those that must be traced themselves;
  // refused[i] of all others is WT_NONE. now: the frame. receivers: with scope = "all", needed there: [i] becomes that
  // of the first ray.
  void share(const DeviceScene& scene, RayQueue& rays, HitList& hits, gpu::Buffer<float>& missed,
             gpu::Buffer<float>& refused, CacheTable& table, uint32_t now, gpu::Buffer<uint32_t>* receivers = nullptr);
  // After elect(): the ray that each ray follows, WT_NONE where it follows none.
  const gpu::Buffer<uint32_t>& representatives() const { return representatives_; }

 private:
  gpu::Context& context_;
  Work work_;
  uint32_t words_;  // of a key, WT_GROUP_WORDS
  gpu::Kernel keys_, elect_, follow_, share_;
  gpu::Buffer<uint64_t> key_words_;
  gpu::Buffer<uint32_t> numbers_, representatives_;  // numbers of rays, by the places of their keys
};

}  // namespace wavetracer
