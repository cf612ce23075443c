// interact: rays that hit enter their prefix into the trie and go on, reflected and compacted in order.
// Assumes hits.block_hits has been scanned.
#pragma once
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"

namespace wavetracer {

class Interact {
 public:
  explicit Interact(gpu::Context& context);
  // next.count becomes hit_count, unless this is the last depth, when next is left alone.
  void operator()(const DeviceScene& scene, const RayQueue& rays, const HitList& hits, uint32_t hit_count,
                  gpu::Buffer<uint64_t>& trie, gpu::Buffer<wt_counters>& counters, RayQueue& next, bool last);

 private:
  gpu::Kernel kernel_;
  uint32_t rays_per_item_, local_;
};

}  // namespace wavetracer
