// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/pack_rays.cl.
#include "passes/pack_rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <stdexcept>

namespace wavetracer {

namespace {

void check_lengths(uint32_t count, std::initializer_list<size_t> lengths) {
  const size_t shortest = std::min(lengths);
  if (shortest < count) throw std::invalid_argument(fmt::format("pack_rays: {} elements of {}", count, shortest));
}

}  // namespace

PackRays::PackRays(gpu::Context& context, Stage stage)
    : stage_(stage),
      local_(context.info().simple_local_size()),
      rays_to_planes_(context),
      planes_to_rays_(context),
      hits_to_planes_(context),
      planes_to_hits_(context) {}

void PackRays::operator()(const gpu::Buffer<wt_packed_ray>& packed, uint32_t count, RayQueue& queue,
                          const gpu::Buffer<uint32_t>* left, const gpu::Buffer<uint32_t>* regions) {
  check_lengths(count, {packed.size(), queue.capacity, left ? left->size() : count, regions ? regions->size() : count});
  queue.count = count;
  rays_to_planes_({count, local_}, stage_,
                  calls::pack_rays::rays_to_planes{.packed = packed,
                                                   .left = left,
                                                   .regions = regions,
                                                   .count = count,
                                                   .rays = queue.planes,
                                                   .capacity = queue.capacity,
                                                   .labelled = queue.plane_count == WT_RAY_LABELLED_PLANES ? 1u : 0u});
}

void PackRays::unpack(const RayQueue& queue, gpu::Buffer<wt_packed_ray>& packed) {
  check_lengths(queue.count, {packed.size()});
  planes_to_rays_({queue.count, local_}, stage_,
                  calls::pack_rays::planes_to_rays{
                      .rays = queue.planes, .capacity = queue.capacity, .count = queue.count, .packed = packed});
}

void PackRays::operator()(const gpu::Buffer<wt_packed_hit>& packed, uint32_t count, HitList& hits) {
  check_lengths(count, {packed.size(), hits.capacity});
  hits_to_planes_({count, local_}, stage_,
                  calls::pack_rays::hits_to_planes{
                      .packed = packed, .count = count, .hits = hits.planes, .capacity = hits.capacity});
}

void PackRays::unpack(const HitList& hits, uint32_t count, gpu::Buffer<wt_packed_hit>& packed) {
  check_lengths(count, {packed.size(), hits.capacity});
  planes_to_hits_({count, local_}, stage_,
                  calls::pack_rays::planes_to_hits{
                      .hits = hits.planes, .capacity = hits.capacity, .count = count, .packed = packed});
}

}  // namespace wavetracer
