// SPDX-License-Identifier: Apache-2.0
// point_floors: for each tile the gain that ways between ends and the tile need for a path above the floor, so that
// point_prefixes leaves out all others before it solves them.
#pragma once
#include <cstdint>
#include <vector>

#include "kernel_calls/point_floors.hpp"
#include "passes/device_scene.hpp"
#include "passes/radio_ends.hpp"
#include "passes/tile_buffers.hpp"

namespace wavetracer {

class PointFloors {
 public:
  // floor: the gain that a path needs, above 0; powers: for each tile a bound of the gain of paths over it whose parts
  // are 1 m long; beside_edge: the other way may go over an edge.
  PointFloors(gpu::Context& context, double floor, const std::vector<double>& powers, bool beside_edge);
  // Finds the floors of a frame.
  void operator()(const DeviceScene& scene, const TileBuffers& tiles, const RadioEnds& ends);
  const gpu::Buffer<wt_point_floor>& list() const { return list_; }

 private:
  gpu::KernelOf<calls::point_floors::point_floors> kernel_;
  uint32_t local_;
  double floor_;
  gpu::Buffer<double> powers_;
  gpu::Buffer<wt_point_floor> list_;
};

}  // namespace wavetracer
