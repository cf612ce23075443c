// SPDX-License-Identifier: Apache-2.0
// pack_rays: rays and hits from records (wavetracer/device/packed_rays.h) to planes (passes/ray_queue.hpp) and back.
#pragma once
#include "kernel_calls/pack_rays.hpp"
#include "passes/ray_queue.hpp"
#include "wavetracer/device/packed_rays.h"

namespace wavetracer {

class PackRays {
 public:
  // stage: whose time it is.
  explicit PackRays(gpu::Context& context, Stage stage = Stage::generate_rays);
  // The queue becomes these rays; t_min and t_max are not kept. left: the triangle that each ray leaves, WT_NONE for
  // none; null: none leaves any. regions: the region of a ray cache, below 2^29; null: 0. Queues of
  // WT_RAY_LABELLED_PLANES get their labels, too. All of these throw std::invalid_argument for lists that are too
  // short.
  void operator()(const gpu::Buffer<wt_packed_ray>& packed, uint32_t count, RayQueue& queue,
                  const gpu::Buffer<uint32_t>* left = nullptr, const gpu::Buffer<uint32_t>* regions = nullptr);
  // packed[i] becomes ray i of the queue, from 0 to infinity.
  void unpack(const RayQueue& queue, gpu::Buffer<wt_packed_ray>& packed);
  // The list becomes these hits; a hit's surface is its triangle.
  void operator()(const gpu::Buffer<wt_packed_hit>& packed, uint32_t count, HitList& hits);
  // packed[i] becomes hit i of the list; u and v become 0.
  void unpack(const HitList& hits, uint32_t count, gpu::Buffer<wt_packed_hit>& packed);

 private:
  Stage stage_;
  uint32_t local_;
  gpu::KernelOf<calls::pack_rays::rays_to_planes> rays_to_planes_;
  gpu::KernelOf<calls::pack_rays::planes_to_rays> planes_to_rays_;
  gpu::KernelOf<calls::pack_rays::hits_to_planes> hits_to_planes_;
  gpu::KernelOf<calls::pack_rays::planes_to_hits> planes_to_hits_;
};

}  // namespace wavetracer
