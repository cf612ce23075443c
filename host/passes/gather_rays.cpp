// Host side of kernels/gather_rays.cl.
// On CPUs a work-item takes a page of each plane in turn, on GPUs one ray.
#include "passes/gather_rays.hpp"

#include <string>

namespace wavetracer {

GatherRays::GatherRays(gpu::Context& context, const char* stage)
    : stage_(stage),
      rays_per_item_(context.info().cpu ? 1024 : 1),
      local_(context.info().cpu ? 1 : context.info().simple_local_size()) {
  kernel_ = context.kernel("gather_rays", "gather_rays", {{"WT_RAYS_PER_ITEM", std::to_string(rays_per_item_) + "u"}});
}

void GatherRays::operator()(const RayQueue& rays, const gpu::Buffer<uint32_t>& order, uint32_t count, RayQueue& next) {
  const size_t items = (size_t{count} + rays_per_item_ - 1) / rays_per_item_;
  kernel_({items, local_}, stage_, rays.planes, rays.capacity, count, order, next.planes, next.plane_count);
  next.count = count;
}

}  // namespace wavetracer
