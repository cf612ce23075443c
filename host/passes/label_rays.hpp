// SPDX-License-Identifier: Apache-2.0
// label_rays: launched rays get their sample, their transmitter, and the note that they have left nothing yet. It needs
// queues with WT_RAY_LABELLED_PLANES.
#pragma once
#include "kernel_calls/label_rays.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class LabelRays {
 public:
  explicit LabelRays(gpu::Context& context);
  // Labels the rays first_slot .. first_slot + count - 1 as samples first_sample, ..., or, where they were launched in
  // an order, as first_sample + order[0], ...
  void operator()(RayQueue& queue, uint32_t first_slot, uint32_t count, uint32_t first_sample);
  void operator()(RayQueue& queue, uint32_t first_slot, uint32_t count, uint32_t first_sample,
                  const gpu::Buffer<uint32_t>& order);
  // Labels all rays; they know their samples (a refined launch).
  void operator()(RayQueue& queue);

 private:
  Work work_;
  gpu::KernelOf<calls::label_rays::label_rays> label_;
  gpu::KernelOf<calls::label_rays::label_rays> label_ordered_;
  gpu::KernelOf<calls::label_rays::label_rays> label_samples_;
};

}  // namespace wavetracer
