// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/rays/label_rays.cl.
// There are three kernels, for different knowledge of the samples.
#include "passes/label_rays.hpp"

#include <string>

namespace wavetracer {

LabelRays::LabelRays(gpu::Context& context) : work_(tuning_of(context.info()).label_rays) {
  const std::string rays = work_.option();
  label_ = {context, {{"WT_RAYS_PER_ITEM", rays}}};
  label_ordered_ = {context, {{"WT_RAYS_PER_ITEM", rays}, {"WT_ORDERED", "1"}}};
  label_samples_ = {context, {{"WT_RAYS_PER_ITEM", rays}, {"WT_KEEP_SAMPLES", "1"}}};
}

namespace {
const gpu::Buffer<uint32_t>* const unordered = nullptr;
}

void LabelRays::operator()(RayQueue& queue, uint32_t first_slot, uint32_t count, uint32_t first_sample) {
  label_(work_.range(count), Stage::generate_rays,
         calls::label_rays::label_rays{.rays = queue.planes,
                                       .capacity = queue.capacity,
                                       .first_slot = first_slot,
                                       .count = count,
                                       .first_sample = first_sample,
                                       .order = unordered});
}

void LabelRays::operator()(RayQueue& queue, uint32_t first_slot, uint32_t count, uint32_t first_sample,
                           const gpu::Buffer<uint32_t>& order) {
  label_ordered_(work_.range(count), Stage::generate_rays,
                 calls::label_rays::label_rays{.rays = queue.planes,
                                               .capacity = queue.capacity,
                                               .first_slot = first_slot,
                                               .count = count,
                                               .first_sample = first_sample,
                                               .order = order});
}

void LabelRays::operator()(RayQueue& queue) {
  label_samples_(work_.range(queue.count), Stage::generate_rays,
                 calls::label_rays::label_rays{.rays = queue.planes,
                                               .capacity = queue.capacity,
                                               .first_slot = 0u,
                                               .count = queue.count,
                                               .first_sample = 0u,
                                               .order = unordered});
}

}  // namespace wavetracer
