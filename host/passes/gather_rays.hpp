// gather_rays: the rays of a queue into another, permuted.
// Assumes two queues of one capacity.
#pragma once
#include "passes/ray_queue.hpp"

namespace wavetracer {

class GatherRays {
 public:
  explicit GatherRays(gpu::Context& context);
  // next becomes rays[order[0]], rays[order[1]], ...
  void operator()(const RayQueue& rays, const gpu::Buffer<uint32_t>& order, RayQueue& next);

 private:
  gpu::Kernel kernel_;
  uint32_t rays_per_item_, local_;
};

}  // namespace wavetracer
