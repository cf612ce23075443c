// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/trace_rays.cl.
// A work-item takes a run of rays on CPUs, one ray elsewhere.
#include "passes/trace_rays.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace wavetracer {

namespace {

void check_rays(size_t rays, size_t results, uint32_t count) {
  if (rays < count || results < count)
    throw std::invalid_argument(
        fmt::format("trace_rays: {} rays, but the buffers hold {} rays and {} results", count, rays, results));
}

}  // namespace

TraceRays::TraceRays(gpu::Context& context, const DeviceTrees& trees)
    : work_(context.info().cpu ? Work{16, 16} : Work{1, 128}) {
  gpu::Definitions definitions = trees.definitions;
  definitions["WT_RAYS_PER_ITEM"] = work_.option();
  nearest_ = {context, definitions};
  definitions["WT_ANY_HIT"] = "1";
  any_ = {context, definitions};
}

void TraceRays::nearest(const DeviceTrees& trees, const gpu::Buffer<float>& corners,
                        const gpu::Buffer<wt_packed_ray>& rays, uint32_t count, gpu::Buffer<wt_packed_hit>& hits) {
  check_rays(rays.size(), hits.size(), count);
  if (corners.size() / 9 < trees.primitive_count)
    throw std::invalid_argument(
        fmt::format("trace_rays: {} coordinates for {} triangles", corners.size(), trees.primitive_count));
  nearest_(work_.range(count), Stage::trace,
           calls::trace_rays::nearest_hits{.nodes = trees.leg_nodes(),
                                           .triangles = trees.leg_leaves(),
                                           .triangle_slots = trees.triangle_slots,
                                           .extent_m = trees.extent_m,
                                           .corners = corners,
                                           .rays = rays,
                                           .count = count,
                                           .hits = hits});
}

void TraceRays::any(const DeviceTrees& trees, const gpu::Buffer<wt_packed_ray>& rays, uint32_t count,
                    gpu::Buffer<uint32_t>& met) {
  check_rays(rays.size(), met.size(), count);
  any_(work_.range(count), Stage::trace,
       calls::trace_rays::any_hits{.nodes = trees.leg_nodes(),
                                   .triangles = trees.leg_leaves(),
                                   .triangle_slots = trees.triangle_slots,
                                   .extent_m = trees.extent_m,
                                   .rays = rays,
                                   .count = count,
                                   .met = met});
}

}  // namespace wavetracer
