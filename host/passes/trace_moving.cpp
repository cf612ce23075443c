// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/trace/trace_moving.cl.
// A work-item takes a run of rays.
#include "passes/trace_moving.hpp"

namespace wavetracer {

TraceMoving::TraceMoving(gpu::Context& context, const DeviceScene& scene)
    : work_(tuning_of(context.info()).trace_moving) {
  gpu::Definitions definitions = scene.definitions;
  definitions["WT_RAYS_PER_ITEM"] = work_.option();
  kernel_ = {context, definitions};
}

void TraceMoving::operator()(const DeviceScene& scene, const RayQueue& rays, HitList& hits) {
  kernel_(work_.range(rays.count), Stage::trace_moving,
          calls::trace_moving::trace_moving{.moving = scene.moving,
                                            .extent_m = scene.extent_m,
                                            .rays = rays.planes,
                                            .capacity = rays.capacity,
                                            .ray_count = rays.count,
                                            .hits = hits.planes});
}

}  // namespace wavetracer
