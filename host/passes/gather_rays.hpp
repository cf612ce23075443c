// gather_rays: the rays of a queue into another, permuted.
// Assumes two queues of one capacity.
#pragma once
#include "passes/ray_queue.hpp"

namespace wavetracer {

class GatherRays {
 public:
  explicit GatherRays(gpu::Context& context) : kernel_(context.kernel("gather_rays", "gather_rays")) {}
  // next becomes rays[order[0]], rays[order[1]], ...
  void operator()(const RayQueue& rays, const gpu::Buffer<uint32_t>& order, RayQueue& next) {
    kernel_({rays.count, 64}, "order", rays.planes, rays.capacity, rays.count, order, next.planes);
    next.count = rays.count;
  }

 private:
  gpu::Kernel kernel_;
};

}  // namespace wavetracer
