// SPDX-License-Identifier: Apache-2.0
// waypoints: the places where rays start and end, segment by segment, one row per sample. It needs labelled queues (see
// label_rays), and every depth of a batch must pass once, in order.
#pragma once
#include <vector>

#include "kernel_calls/waypoints.hpp"
#include "passes/ray_queue.hpp"
#include "wavetracer/device/waypoints.h"

namespace wavetracer {

class Waypoints {
 public:
  Waypoints(gpu::Context& context, uint32_t max_depth);
  // Makes room for batches of this many samples.
  void reserve(uint64_t samples);
  // Makes rows for the samples first_sample .. first_sample + count - 1. Old rows are lost.
  void begin_batch(uint32_t first_sample, uint32_t count);
  // Adds the segments of rays that have had `depth` interactions. The ends of segments after the last interaction are
  // not kept. traced: for each ray WT_NONE where a ray cache answered it; null without a cache.
  void operator()(const RayQueue& rays, const HitList& hits, uint32_t depth,
                  const gpu::Buffer<float>* traced = nullptr);
  // Returns the rows of these samples, stride() waypoints each. Waypoints after a miss are undefined.
  std::vector<wt_waypoint> rows(const std::vector<uint32_t>& samples);
  uint32_t stride() const { return stride_; }
  // Device memory of a sample.
  static uint64_t bytes_a_sample(uint32_t max_depth) { return (uint64_t{max_depth} + 1) * sizeof(wt_waypoint); }

 private:
  gpu::Context& context_;
  gpu::KernelOf<calls::waypoints::waypoints> kernel_;
  gpu::KernelOf<calls::waypoints::gather_waypoints> gather_;
  uint32_t stride_, local_, first_sample_ = 0;
  gpu::Buffer<wt_waypoint> list_, rows_;
  gpu::Buffer<uint32_t> samples_;
};

}  // namespace wavetracer
