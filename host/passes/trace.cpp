// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/trace_bvh2.cl, trace_bvh8.cl and trace_packet16.cl.
// On CPUs a work-item is a block of 16 rays, on GPUs a ray.
#include "passes/trace.hpp"

#include <stdexcept>
#include <string>

#include "passes/tuning.hpp"

namespace wavetracer {

namespace {

const char* program_of(TraceShape shape) {
  switch (shape) {
    case TraceShape::bvh2:
      return "trace_bvh2";
    case TraceShape::bvh8:
      return "trace_bvh8";
    case TraceShape::packet16:
      return "trace_packet16";
  }
  throw std::invalid_argument("trace: no such shape");
}

}  // namespace

Trace::Trace(gpu::Context& context, const DeviceScene& scene, TraceShape shape, const LaunchShape& launch, Scope scope)
    : shape_(shape),
      launch_(launch),
      block_(tuning_of(context.info()).block),
      blocks_group_(tuning_of(context.info()).trace_group),
      counts_blocks_(shape != TraceShape::bvh2 || launch.plain()) {
  gpu::Definitions definitions = scene.definitions;
  if (scope == Scope::fixed) definitions.erase("WT_INSTANCES");
  launch.define(definitions);
  if (counts_blocks_) definitions["WT_COUNT_BLOCKS"] = "1";
  definitions["WT_BLOCK"] = std::to_string(block_);
  kernel_ = context.kernel(program_of(shape), "trace", definitions);
}

void Trace::operator()(const DeviceScene& scene, const RayQueue& rays, HitList& hits) {
  const uint32_t blocks = (rays.count + block_ - 1) / block_;
  switch (shape_) {
    case TraceShape::bvh2:
      kernel_(launch_.range(rays.count, block_), Stage::trace, scene.nodes2, scene.triangles2, scene.triangle_slots,
              scene.moving, scene.extent_m, rays.planes, rays.capacity, rays.count, hits.planes, hits.block_hits);
      break;
    case TraceShape::bvh8:
      kernel_(launch_.range(blocks, blocks_group_), Stage::trace, scene.nodes8, scene.blocks8, scene.moving,
              scene.extent_m, rays.planes, rays.capacity, rays.count, hits.planes, hits.block_hits);
      break;
    case TraceShape::packet16:
      kernel_(launch_.range(blocks, blocks_group_), Stage::trace, scene.packet_nodes2, scene.triangles2,
              scene.triangle_slots, scene.nodes8, scene.blocks8, scene.moving, scene.extent_m, rays.planes,
              rays.capacity, rays.count, hits.planes, hits.block_hits);
      break;
  }
}

}  // namespace wavetracer
