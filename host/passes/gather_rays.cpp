// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/rays/gather_rays.cl.
// A work-item copies its part of one plane after the other.
#include "passes/gather_rays.hpp"

namespace wavetracer {

GatherRays::GatherRays(gpu::Context& context, Stage stage)
    : stage_(stage),
      work_(tuning_of(context.info()).gather_rays),
      kernel_(context, {{"WT_RAYS_PER_ITEM", work_.option()}}) {}

void GatherRays::operator()(const RayQueue& rays, const gpu::Buffer<uint32_t>& order, uint32_t count, RayQueue& next) {
  kernel_(work_.range(count), stage_,
          calls::gather_rays::gather_rays{.rays = rays.planes,
                                          .capacity = rays.capacity,
                                          .count = count,
                                          .order = order,
                                          .next = next.planes,
                                          .plane_count = next.plane_count});
  next.count = count;
}

}  // namespace wavetracer
