// SPDX-License-Identifier: Apache-2.0
// receive: finds rays that pass receivers within a radius, the thesis' way of reception. The list grows until it holds
// them. It needs labelled queues (see label_rays).
#pragma once
#include <vector>

#include "kernel_calls/receive.hpp"
#include "passes/radio_ends.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/device/waypoints.h"

namespace wavetracer {

class Receive {
 public:
  Receive(gpu::Context& context, double radius_m);
  // Removes all receptions.
  void begin_batch();
  // Adds the receptions of rays that have had `depth` interactions.
  void operator()(const RadioEnds& ends, const RayQueue& rays, const HitList& hits, uint32_t depth);
  // The same where a ray cache has answered rays: for them traced[i] is WT_NONE (as a bit pattern), and answered[i] is
  // the one receiver that they pass, or WT_NONE, no matter how far their own segment is from it.
  void operator()(const RadioEnds& ends, const RayQueue& rays, const HitList& hits, uint32_t depth,
                  const gpu::Buffer<float>& traced, const gpu::Buffer<uint32_t>& answered);
  // Sets first[i] to the receiver whose sphere ray i enters first, or WT_NONE.
  void first(const RadioEnds& ends, const RayQueue& rays, const HitList& hits, gpu::Buffer<uint32_t>& first);
  // Returns the receptions in no particular order.
  std::vector<wt_reception> list() const;

 private:
  void append(gpu::KernelOf<calls::receive::receive>& kernel, const RadioEnds& ends, const RayQueue& rays,
              const HitList& hits, uint32_t depth, const gpu::Buffer<float>* traced,
              const gpu::Buffer<uint32_t>* answered);

  gpu::Context& context_;
  gpu::KernelOf<calls::receive::receive> receive_;
  gpu::KernelOf<calls::receive::receive> receive_answered_;
  gpu::KernelOf<calls::receive::first_receiver> first_;
  float radius_m_;
  Work work_;
  uint32_t count_ = 0;
  gpu::Buffer<wt_reception> list_;
  gpu::Buffer<uint32_t> counter_;
};

}  // namespace wavetracer
