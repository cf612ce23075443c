// SPDX-License-Identifier: Apache-2.0
// The trees over triangles on the device, in every form that this kind of device may trace. They need nothing of a
// scene: each triangle has a number, and the number of the surface that it is a part of.
#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "accel/triangles.hpp"
#include "gpu/gpu.hpp"
#include "wavetracer/device/bvh.h"

namespace wavetracer {

// Forms of tracing rays: GPUs trace one ray per work-item through a BVH2; CPUs trace through a BVH8, or in packets of
// 16 through the BVH2.
enum class TraceShape { bvh2, bvh8, packet16 };

struct DeviceTrees {
  gpu::Buffer<wt_centred_node> nodes2;       // BVH2 for one ray per work-item
  gpu::Buffer<wt_bvh2_node> packet_nodes2;   // BVH2 for packets (CPUs only)
  gpu::Buffer<wt_bvh2_triangle> triangles2;  // triangles of both trees
  gpu::Buffer<wt_bvh8_node> nodes8;          // BVH8 (CPUs only)
  gpu::Buffer<wt_triangle_block> blocks8;
  uint32_t triangle_slots = 0;
  uint32_t primitive_count = 0;  // triangles
  float extent_m = 0;            // largest absolute coordinate of triangles and rays
  bool cpu = false;
  // Trees of things that move, by passes/place.hpp; a placeholder where nothing moves. wavetracer/device/moving.h
  gpu::Buffer<wt_float4> moving;
  gpu::Definitions definitions;  // stack sizes that the trees need

  // The tree that legs of paths are tested against: BVH8 on CPUs, BVH2 elsewhere (kernels/lib/legs.clh).
  const gpu::Memory& leg_nodes() const { return cpu ? static_cast<const gpu::Memory&>(nodes8) : nodes2; }
  const gpu::Memory& leg_leaves() const { return cpu ? static_cast<const gpu::Memory&>(blocks8) : triangles2; }
  // Makes the stack called `name` at least this large; sizes grow in steps, so that scenes of similar size share
  // kernels.
  void require_stack(const std::string& name, uint32_t entries);
};

// In scenes whose coordinates are not larger than this, rays included, float32 decides on which side of an edge a leg
// passes: it errs by less than WT_UNDECIDED_M, within which the fields at the edge ask whether the leg is free. In
// larger ones double decides beside sides of triangles (kernels/lib/met.clh), at half as much time again for tests of
// legs.
constexpr float largest_scene_of_float32_m = 1000;

// Builds the trees and uploads them. spatial_splits: see accel/build.hpp. extent_m: the largest absolute coordinate of
// any triangle or origin of a ray; boxes are padded for the rounding of such distances.
DeviceTrees make_device_trees(gpu::Context& context, std::span<const AccelTriangle> triangles, bool spatial_splits,
                              float extent_m);

}  // namespace wavetracer
