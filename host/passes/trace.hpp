// SPDX-License-Identifier: Apache-2.0
// trace: nearest hits of a queue of rays, and the hits of every block of rays; in launches of any shape.
// At equal distances the lower primitive counts, so shapes, devices and trees all give the same hits.
#pragma once
#include "kernel_calls/trace_bvh2.hpp"
#include "kernel_calls/trace_bvh8.hpp"
#include "kernel_calls/trace_packet16.hpp"
#include "passes/device_trees.hpp"
#include "passes/launch_shape.hpp"
#include "passes/ray_queue.hpp"

namespace wavetracer {

class Trace {
 public:
  // The traced part: everything, or only the static scene (see trace_moving).
  enum class Scope { all, fixed };

  // The blocks of bvh8 and packet16 have 16 rays on every device, and hits must have such blocks, too.
  Trace(gpu::Context& context, const DeviceTrees& scene, TraceShape shape, const LaunchShape& launch = {},
        Scope scope = Scope::all);
  // Does it count the hits of blocks? If not (launches of another shape on GPUs), Compact::count_blocks does it.
  bool counts_blocks() const { return counts_blocks_; }
  void operator()(const DeviceTrees& scene, const RayQueue& rays, HitList& hits);

 private:
  gpu::KernelOf<calls::trace_bvh2::trace> bvh2_;  // one of the three, by the shape
  gpu::KernelOf<calls::trace_bvh8::trace> bvh8_;
  gpu::KernelOf<calls::trace_packet16::trace> packet16_;
  TraceShape shape_;
  LaunchShape launch_;
  uint32_t block_, blocks_group_;
  bool counts_blocks_;
};

}  // namespace wavetracer
