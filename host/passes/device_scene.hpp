// SPDX-License-Identifier: Apache-2.0
// The scene on the device: the trees of its triangles, and surfaces in float and double; place adds those of instances
// to the static ones. simulation/hit_finder.cpp chooses the form of the tree.
#pragma once
#include <cstdint>
#include <vector>

#include "gpu/gpu.hpp"
#include "passes/device_trees.hpp"
#include "wavetracer/device/records.h"
#include "wavetracer/scene.hpp"

namespace wavetracer {

struct DeviceScene : DeviceTrees {
  gpu::Buffer<wt_surface> surfaces;
  gpu::Buffer<wt_exact_surface> exact_surfaces;
  gpu::Buffer<double> exact_triangles;  // nine doubles a triangle, grouped by surface
  // Data of things that move, by passes/place.hpp; a placeholder where nothing moves.
  gpu::Buffer<wt_exact_instance> exact_instances;
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

// Builds the trees and uploads everything. spatial_splits: see accel/build.hpp. reach_m: the largest absolute recentred
// coordinate of any ray's origin outside the scene's bounding box; boxes are padded for the rounding of such distances.
// opaque: see device_surfaces(); flags behind those of the scene are left out.
DeviceScene make_device_scene(gpu::Context& context, const Scene& scene, bool spatial_splits, double reach_m = 0,
                              const std::vector<bool>& opaque = {});

}  // namespace wavetracer
