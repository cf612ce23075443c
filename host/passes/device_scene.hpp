// SPDX-License-Identifier: Apache-2.0
// The scene on the device: acceleration structures in every form that this kind of device may trace, and surfaces in
// float and double; place adds those of instances to the static ones. simulation/hit_finder.cpp chooses the form.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/gpu.hpp"
#include "wavetracer/device/bvh.h"
#include "wavetracer/device/records.h"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Forms of tracing rays: GPUs trace one ray per work-item through a BVH2; CPUs trace through a BVH8, or in packets of
// 16 through the BVH2.
enum class TraceShape { bvh2, bvh8, packet16 };

struct DeviceScene {
  gpu::Buffer<wt_centred_node> nodes2;       // BVH2 for one ray per work-item
  gpu::Buffer<wt_bvh2_node> packet_nodes2;   // BVH2 for packets (CPUs only)
  gpu::Buffer<wt_bvh2_triangle> triangles2;  // triangles of both trees
  gpu::Buffer<wt_bvh8_node> nodes8;          // BVH8 (CPUs only)
  gpu::Buffer<wt_triangle_block> blocks8;
  uint32_t triangle_slots = 0;
  float extent_m = 0;  // largest absolute coordinate of scene and rays, recentred
  bool cpu = false;
  gpu::Buffer<wt_surface> surfaces;
  gpu::Buffer<wt_exact_surface> exact_surfaces;
  gpu::Buffer<double> exact_triangles;  // nine doubles a triangle, grouped by surface
  uint32_t primitive_count = 0;         // triangles of the static scene
  // Data of things that move, by passes/place.hpp; placeholders where nothing moves.
  gpu::Buffer<wt_float4> moving;  // wavetracer/device/moving.h
  gpu::Buffer<wt_exact_instance> exact_instances;
  gpu::Definitions definitions;  // stack sizes that the trees need

  // The tree that legs of paths are tested against: BVH8 on CPUs, BVH2 elsewhere (kernels/lib/legs.clh).
  const gpu::Memory& leg_nodes() const { return cpu ? static_cast<const gpu::Memory&>(nodes8) : nodes2; }
  const gpu::Memory& leg_leaves() const { return cpu ? static_cast<const gpu::Memory&>(blocks8) : triangles2; }
  // Makes the stack called `name` at least this large; sizes grow in steps, so that scenes of similar size share
  // kernels.
  void require_stack(const std::string& name, uint32_t entries);
};

// The corners of the triangles of all surfaces, grouped by surface, nine doubles each.
std::vector<double> surface_corners(const Scene& scene);

// The surfaces of a world as kernels read them, by their number.
struct SurfaceRecords {
  std::vector<wt_surface> surfaces;
  std::vector<wt_exact_surface> exact;
};

// The surfaces of a scene, and behind them room for `more` surfaces of instances, which place fills. opaque: for each
// of all these, whether no wave passes it; empty where no kernel asks.
SurfaceRecords device_surfaces(const Scene& scene, size_t more, const std::vector<bool>& opaque);

// In scenes whose coordinates are not larger than this, rays included, float32 decides on which side of an edge a leg
// passes: it errs by less than WT_UNDECIDED_M, within which the fields at the edge ask whether the leg is free. In
// larger ones double decides beside sides of triangles (kernels/lib/met.clh), at half as much time again for tests of
// legs.
constexpr float largest_scene_of_float32_m = 1000;

// Builds the trees and uploads everything. spatial_splits: see accel/build.hpp. reach_m: the largest absolute recentred
// coordinate of any ray's origin outside the scene's bounding box; boxes are padded for the rounding of such distances.
// opaque: see device_surfaces(); flags behind those of the scene are left out.
DeviceScene make_device_scene(gpu::Context& context, const Scene& scene, bool spatial_splits, double reach_m = 0,
                              const std::vector<bool>& opaque = {});

}  // namespace wavetracer
