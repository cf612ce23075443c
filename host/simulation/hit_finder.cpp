// SPDX-License-Identifier: Apache-2.0
// Traces rays; in launches of another shape a later pass counts their hits.
#include "simulation/hit_finder.hpp"

namespace wavetracer {

// Packets are faster as long as neighbours in the queue travel together. They do so to the last depth if rays were
// launched or sorted in order.
TraceShape choose_shape(const gpu::DeviceInfo& device, const TraceConfig& trace, const OrderPlan& order) {
  if (!device.cpu) return TraceShape::bvh2;
  return at_random(trace.directions) && !order.key ? TraceShape::bvh8 : TraceShape::packet16;
}

TracedHits::TracedHits(gpu::Context& context, const DeviceScene& scene, TraceShape shape, const LaunchShape& launch)
    : trace_(context, scene, shape, launch) {
  if (!trace_.counts_blocks()) compact_.emplace(context);
}

void TracedHits::find(const DeviceScene& scene, RayQueue& rays, HitList& hits, uint32_t) { trace_(scene, rays, hits); }

void TracedHits::count_blocks(const RayQueue& rays, HitList& hits, uint32_t) {
  if (compact_)
    compact_->count_blocks(hits.planes, size_t{WT_HIT_SURFACE} * hits.capacity, rays.count, hits.block_hits);
}

}  // namespace wavetracer
