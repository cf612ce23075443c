// SPDX-License-Identifier: Apache-2.0
// trace_rays: hits of packed rays (wavetracer/device/packed_rays.h) with the triangles of trees: the nearest ones, and
// whether there is any. It traces through the BVH8 on CPUs and through the BVH2 elsewhere.
#pragma once
#include "kernel_calls/trace_rays.hpp"
#include "passes/device_trees.hpp"
#include "passes/tuning.hpp"

namespace wavetracer {

class TraceRays {
 public:
  TraceRays(gpu::Context& context, const DeviceTrees& trees);
  // hits[i] becomes the nearest hit of rays[i], for i < count. corners: nine floats for each triangle, by its
  // primitive; the weights of a hit are of these. Throws std::invalid_argument for buffers that are too short.
  void nearest(const DeviceTrees& trees, const gpu::Buffer<float>& corners, const gpu::Buffer<wt_packed_ray>& rays,
               uint32_t count, gpu::Buffer<wt_packed_hit>& hits);
  // met[i] becomes 1 where rays[i] meets a triangle, else 0.
  void any(const DeviceTrees& trees, const gpu::Buffer<wt_packed_ray>& rays, uint32_t count,
           gpu::Buffer<uint32_t>& met);

 private:
  Work work_;
  gpu::KernelOf<calls::trace_rays::nearest_hits> nearest_;
  gpu::KernelOf<calls::trace_rays::any_hits> any_;
};

}  // namespace wavetracer
