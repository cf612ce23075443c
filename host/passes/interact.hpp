// interact: rays that hit enter their prefix into the trie and go on, reflected and compacted in order; where a queue
// for them is given, also straight through what they hit.
// Assumes hits.block_hits has been scanned.
#pragma once
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"

namespace wavetracer {

class Interact {
 public:
  // keep_ages: as the set of sequences was made. samples: rays carry the number of their sample, and note its end.
  // labels: queues have WT_RAY_LABELLED_PLANES, see label_rays. transmission: operator() may be given `through`.
  explicit Interact(gpu::Context& context, bool keep_ages = false, bool samples = false, bool labels = false,
                    bool transmission = false);
  // next.count becomes hit_count, unless this is the last depth, when next is left alone. Sequences that rays
  // reach get the bits of their quarters, and the age `now`, where ages are kept. ends: one a sample, needed where
  // samples are followed. through, of the capacity of the others: its count becomes hit_count, and ray i is ray i of
  // next, not reflected but behind the surface, with the node that it came with.
  void operator()(const DeviceScene& scene, const RayQueue& rays, const HitList& hits, uint32_t hit_count,
                  gpu::Buffer<uint64_t>& trie, gpu::Buffer<uint32_t>& quarters, gpu::Buffer<wt_counters>& counters,
                  gpu::Buffer<uint32_t>& ages, uint32_t now, RayQueue& next, bool last,
                  const gpu::Buffer<uint32_t>* ends = nullptr, RayQueue* through = nullptr);

 private:
  gpu::Kernel kernel_, kernel_through_;
  uint32_t rays_per_item_, local_;
};

}  // namespace wavetracer
