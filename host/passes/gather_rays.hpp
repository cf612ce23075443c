// SPDX-License-Identifier: Apache-2.0
// gather_rays: copies rays of a queue into another, permuted or selected. It needs two queues of one capacity, the
// second with no more planes than the first.
#pragma once
#include "kernel_calls/gather_rays.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class GatherRays {
 public:
  // stage: whose time it is.
  explicit GatherRays(gpu::Context& context, Stage stage = Stage::order);
  // next becomes rays[order[0]], ..., rays[order[count - 1]].
  void operator()(const RayQueue& rays, const gpu::Buffer<uint32_t>& order, uint32_t count, RayQueue& next);

 private:
  Stage stage_;
  Work work_;
  gpu::KernelOf<calls::gather_rays::gather_rays> kernel_;
};

}  // namespace wavetracer
