// SPDX-License-Identifier: Apache-2.0
// top_level: the top-level tree over the instances of a frame, built on the device from their records there.
// The host only gives it their number, and nothing is read back. Keys are sorted between its two halves.
#pragma once
#include <cstdint>
#include <vector>

#include "kernel_calls/top_level.hpp"
#include "passes/device_scene.hpp"
#include "wavetracer/device/moving.h"

namespace wavetracer {

// The keys to sort, and the permutation that sorts them, for the second half.
struct InstanceOrder {
  static constexpr unsigned key_level = 15;                // bits of a coordinate
  static constexpr unsigned key_bits = 2 * key_level + 1;  // one more for absent instances
  gpu::Buffer<uint32_t> keys, order;
  uint32_t count;
};

class TopLevelTree {
 public:
  // bodies: those of Place.
  TopLevelTree(gpu::Context& context, const std::vector<wt_body>& bodies);
  // Makes a key for each instance; those of absent ones are last. Place must have moved the instances.
  InstanceOrder& keys(const DeviceScene& scene);
  // Writes tree and records of the first `present` instances of the sorted order; no others are present.
  void operator()(DeviceScene& scene, uint32_t present);

 private:
  uint32_t local_, group_;
  gpu::KernelOf<calls::top_level::instance_keys> instance_keys_;
  gpu::KernelOf<calls::top_level::leaves> leaves_;
  gpu::KernelOf<calls::top_level::inner_boxes> inner_boxes_;
  gpu::KernelOf<calls::top_level::top_nodes> top_nodes_;
  gpu::Buffer<wt_body> bodies_;
  InstanceOrder instances_;
  gpu::Buffer<float> boxes_, tree_;  // those of instances; those of nodes and leaves; eight floats each
};

}  // namespace wavetracer
