// Host side of kernels/trace_moving.cl.
// On CPUs a work-item takes 16 rays in turn.
#include "passes/trace_moving.hpp"

#include <string>

namespace wavetracer {

TraceMoving::TraceMoving(gpu::Context& context, const DeviceScene& scene)
    : rays_per_item_(context.info().cpu ? 16 : 1), local_(context.info().cpu ? 16 : 128) {
  gpu::Definitions definitions = scene.definitions;
  definitions["WT_RAYS_PER_ITEM"] = std::to_string(rays_per_item_) + "u";
  kernel_ = context.kernel("trace_moving", "trace_moving", definitions);
}

void TraceMoving::operator()(const DeviceScene& scene, const RayQueue& rays, HitList& hits) {
  kernel_({(size_t{rays.count} + rays_per_item_ - 1) / rays_per_item_, local_}, "trace_moving", scene.moving,
          scene.extent_m, rays.planes, rays.capacity, rays.count, hits.planes);
}

}  // namespace wavetracer
