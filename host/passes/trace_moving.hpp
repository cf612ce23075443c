// SPDX-License-Identifier: Apache-2.0
// trace_moving: replaces hits of the static scene by those of instances that come before them. It needs a scene with
// instances (passes/place.hpp), and hits by a Trace of Scope::fixed.
#pragma once
#include "kernel_calls/trace_moving.hpp"
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class TraceMoving {
 public:
  TraceMoving(gpu::Context& context, const DeviceScene& scene);
  void operator()(const DeviceScene& scene, const RayQueue& rays, HitList& hits);

 private:
  Work work_;
  gpu::KernelOf<calls::trace_moving::trace_moving> kernel_;
};

}  // namespace wavetracer
