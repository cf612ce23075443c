// SPDX-License-Identifier: Apache-2.0
// targets: rows of paths transmitter - point of a target - receiver. Rays do not see points, so every link meets every
// point. The rows are a list of their own, which occlusion and visible take like that of solve.
#pragma once
#include <cstdint>
#include <vector>

#include "kernel_calls/targets.hpp"
#include "passes/counters.hpp"
#include "passes/device_scene.hpp"
#include "passes/link_pairs.hpp"
#include "passes/radio_ends.hpp"
#include "passes/solved_list.hpp"
#include "passes/step_tables.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/records.h"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

class TargetRows {
 public:
  // points: the number of points in every frame, at least one; max_depth: interactions that a row has room for.
  TargetRows(gpu::Context& context, uint32_t points, uint32_t max_depth);
  // Writes the points of a frame.
  void place(const WorldState& world);
  // Rows are ordered by links, then by points. Throws RuntimeError where they outgrow the buffers of the device.
  SolvedList& operator()(const DeviceScene& scene, const RadioEnds& ends);
  const gpu::Buffer<wt_target_point>& points() const { return points_; }
  uint32_t count() const { return count_; }

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::targets::targets> kernel_;
  Work work_;
  uint32_t count_;
  gpu::Buffer<wt_target_point> points_;
  LinkPairs links_;
  SolvedList solved_;
};

// target_bodies: paths have no mirrors, tiles and edges on bodies that are targets themselves.
class TargetBodies {
 public:
  // is_body: not 0 for each instance whose body is a target; there is one.
  TargetBodies(gpu::Context& context, const std::vector<uint32_t>& is_body);
  // Marks solved paths with a step on such a body as obstructed.
  void operator()(const DeviceScene& scene, SolvedList& solved, Counters& counters, const StepTables& steps);

 private:
  gpu::KernelOf<calls::targets::target_bodies> kernel_;
  uint32_t group_;
  gpu::Buffer<uint32_t> is_body_;
};

}  // namespace wavetracer
