// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/label_rays.cl.
// There are three kernels, for different knowledge of the samples.
#include "passes/label_rays.hpp"

#include <string>

namespace wavetracer {

LabelRays::LabelRays(gpu::Context& context) : work_(tuning_of(context.info()).label_rays) {
  const std::string rays = work_.option();
  label_ = context.kernel("label_rays", "label_rays", {{"WT_RAYS_PER_ITEM", rays}});
  label_ordered_ = context.kernel("label_rays", "label_rays", {{"WT_RAYS_PER_ITEM", rays}, {"WT_ORDERED", "1"}});
  label_samples_ = context.kernel("label_rays", "label_rays", {{"WT_RAYS_PER_ITEM", rays}, {"WT_KEEP_SAMPLES", "1"}});
}

namespace {
const gpu::Buffer<uint32_t>* const unordered = nullptr;
}

void LabelRays::operator()(RayQueue& queue, uint32_t first_slot, uint32_t count, uint32_t first_sample) {
  label_(work_.range(count), Stage::generate_rays, queue.planes, queue.capacity, first_slot, count, first_sample,
         unordered);
}

void LabelRays::operator()(RayQueue& queue, uint32_t first_slot, uint32_t count, uint32_t first_sample,
                           const gpu::Buffer<uint32_t>& order) {
  label_ordered_(work_.range(count), Stage::generate_rays, queue.planes, queue.capacity, first_slot, count,
                 first_sample, order);
}

void LabelRays::operator()(RayQueue& queue) {
  label_samples_(work_.range(queue.count), Stage::generate_rays, queue.planes, queue.capacity, 0u, queue.count, 0u,
                 unordered);
}

}  // namespace wavetracer
