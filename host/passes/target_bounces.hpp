// SPDX-License-Identifier: Apache-2.0
// target_bounces: rows of paths that bounce within a body before or after one of its pieces scatters them. The rows are
// a list of their own, which target_bodies, occlusion and visible take like that of solve.
#pragma once
#include <cstdint>
#include <vector>

#include "kernel_calls/target_bounces.hpp"
#include "passes/device_scene.hpp"
#include "passes/link_pairs.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/targets.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/points.h"

namespace wavetracer {

class TargetBounces {
 public:
  // bounces: all chains of all frames, at least one; max_depth: interactions that a row has room for, as many as the
  // longest chain and its piece at least.
  TargetBounces(gpu::Context& context, const std::vector<wt_target_bounce>& bounces, uint32_t max_depth);
  // Rows are in any order. targets: the points of the frame, which say as well which paths are too weak. Throws
  // RuntimeError where the rows outgrow the buffers of the device.
  SolvedList& operator()(const DeviceScene& scene, const RadioEnds& ends, const TargetRows& targets);
  // The number of paths that the last call left out, because they are surely below the floor.
  uint64_t weak() const { return weak_; }

 private:
  void launch(const DeviceScene& scene, const RadioEnds& ends, const TargetRows& targets);

  gpu::Context& context_;
  gpu::KernelOf<calls::target_bounces::target_bounces> kernel_;
  Work work_;
  gpu::Buffer<wt_target_bounce> bounces_;
  gpu::Buffer<uint32_t> counts_;
  uint64_t weak_ = 0;
  LinkPairs links_;
  SolvedList solved_;
};

}  // namespace wavetracer
