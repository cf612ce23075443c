// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/trace/trace_bvh2.cl, trace_bvh8.cl and trace_packet16.cl.
// On CPUs a work-item is a block of 16 rays, on GPUs a ray.
#include "passes/trace.hpp"

#include <string>

#include "passes/tuning.hpp"

namespace wavetracer {

namespace {

constexpr uint32_t lanes = 16;  // rays of a block for the trees of CPUs

}  // namespace

Trace::Trace(gpu::Context& context, const DeviceTrees& scene, TraceShape shape, const LaunchShape& launch, Scope scope)
    : shape_(shape),
      launch_(launch),
      block_(shape == TraceShape::bvh2 ? tuning_of(context.info()).block : lanes),
      blocks_group_(tuning_of(context.info()).trace_group),
      counts_blocks_(shape != TraceShape::bvh2 || launch.plain()) {
  gpu::Definitions definitions = scene.definitions;
  if (scope == Scope::fixed) definitions.erase("WT_INSTANCES");
  launch.define(definitions);
  if (counts_blocks_) definitions["WT_COUNT_BLOCKS"] = "1";
  definitions["WT_BLOCK"] = std::to_string(block_);
  if (shape == TraceShape::bvh2) bvh2_ = {context, definitions};
  if (shape == TraceShape::bvh8) bvh8_ = {context, definitions};
  if (shape == TraceShape::packet16) packet16_ = {context, definitions};
}

void Trace::operator()(const DeviceTrees& scene, const RayQueue& rays, HitList& hits) {
  const uint32_t blocks = (rays.count + block_ - 1) / block_;
  switch (shape_) {
    case TraceShape::bvh2:
      bvh2_(launch_.range(rays.count, block_), Stage::trace,
            calls::trace_bvh2::trace{.nodes = scene.nodes2,
                                     .triangles = scene.triangles2,
                                     .triangle_slots = scene.triangle_slots,
                                     .moving = scene.moving,
                                     .extent_m = scene.extent_m,
                                     .rays = rays.planes,
                                     .capacity = rays.capacity,
                                     .ray_count = rays.count,
                                     .hits = hits.planes,
                                     .block_hits = hits.block_hits});
      break;
    case TraceShape::bvh8:
      bvh8_(launch_.range(blocks, blocks_group_), Stage::trace,
            calls::trace_bvh8::trace{.nodes = scene.nodes8,
                                     .blocks = scene.blocks8,
                                     .moving = scene.moving,
                                     .extent_m = scene.extent_m,
                                     .rays = rays.planes,
                                     .capacity = rays.capacity,
                                     .ray_count = rays.count,
                                     .hits = hits.planes,
                                     .block_hits = hits.block_hits});
      break;
    case TraceShape::packet16:
      packet16_(launch_.range(blocks, blocks_group_), Stage::trace,
                calls::trace_packet16::trace{.nodes = scene.packet_nodes2,
                                             .triangles = scene.triangles2,
                                             .triangle_slots = scene.triangle_slots,
                                             .nodes8 = scene.nodes8,
                                             .blocks = scene.blocks8,
                                             .moving = scene.moving,
                                             .extent_m = scene.extent_m,
                                             .rays = rays.planes,
                                             .capacity = rays.capacity,
                                             .ray_count = rays.count,
                                             .hits = hits.planes,
                                             .block_hits = hits.block_hits});
      break;
  }
}

}  // namespace wavetracer
