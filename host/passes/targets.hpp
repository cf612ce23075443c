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

// The rows that are left out.
struct TargetLimits {
  double floor = 0;  // gain below which a path is left out; 0: none is
  // With a floor: for each point a bound of the gain of paths whose parts before and after it are 1 m long.
  std::vector<double> powers = {};
  bool sides = false;  // some points are pieces of bodies, whose dark sides have no rows
};

class TargetRows {
 public:
  // points: the number of points in every frame, at least one; max_depth: interactions that a row has room for.
  TargetRows(gpu::Context& context, uint32_t points, uint32_t max_depth, const TargetLimits& limits = {});
  // Writes the points of a frame.
  void place(const WorldState& world);
  // Rows are ordered by links, then by points, but for those with a floor or with sides, which are in any order. Throws
  // RuntimeError where they outgrow the buffers of the device.
  SolvedList& operator()(const DeviceScene& scene, const RadioEnds& ends);
  const gpu::Buffer<wt_target_point>& points() const { return points_; }
  uint32_t count() const { return count_; }
  // Those of TargetLimits; null without a floor.
  const gpu::Buffer<double>* powers() const { return floor_ > 0 ? &powers_ : nullptr; }
  double floor() const { return floor_; }
  // The number of paths that the last call left out, because they are surely below the floor.
  uint64_t weak() const { return weak_; }

 private:
  void launch(const DeviceScene& scene, const RadioEnds& ends, uint32_t rows, const gpu::Buffer<uint32_t>* counts);
  // Writes only the rows that may be seen, out of so many, and returns their number.
  uint32_t write_seen(const DeviceScene& scene, const RadioEnds& ends, uint64_t rows);

  gpu::Context& context_;
  gpu::KernelOf<calls::targets::targets> kernel_;
  Work work_;
  uint32_t count_;
  double floor_;
  bool leaves_out_;  // rows that are hidden or weak have no place in the list
  uint64_t weak_ = 0;
  gpu::Buffer<wt_target_point> points_;
  gpu::Buffer<double> powers_;  // made only with a floor
  gpu::Buffer<uint32_t> counts_;
  LinkPairs links_;
  SolvedList solved_;
};

// target_bodies: paths have no mirrors, tiles and edges on bodies that are targets themselves, but for the mirrors of
// bounces within a body (target_bounces.hpp).
class TargetBodies {
 public:
  // is_body: not 0 for each instance whose body is a target; there is one.
  TargetBodies(gpu::Context& context, const std::vector<uint32_t>& is_body);
  // Marks solved paths with a step on such a body as obstructed.
  void operator()(const DeviceScene& scene, SolvedList& solved, Counters& counters, const StepTables& steps,
                  const TargetRows& targets);

 private:
  gpu::KernelOf<calls::targets::target_bodies> kernel_;
  uint32_t group_;
  gpu::Buffer<uint32_t> is_body_;
};

}  // namespace wavetracer
