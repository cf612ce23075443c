// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/rays/order_keys.cl.
// The stage of all its launches is "order".
#include "passes/order_keys.hpp"

#include <bit>
#include <stdexcept>
#include <string>
#include <utility>

namespace wavetracer {

namespace {

const char* function_of(OrderKey key) {
  switch (key) {
    case OrderKey::morton:
      return "wt_key_morton";
    case OrderKey::morton_bins:
      return "wt_key_morton_bins";
    case OrderKey::hilbert_bins:
      return "wt_key_hilbert_bins";
    case OrderKey::direction_origin:
      return "wt_key_direction_origin";
  }
  throw std::invalid_argument("order_keys: no such key");
}

uint32_t bits_of(OrderKey key, uint32_t bins) {
  if (key == OrderKey::morton) return 30;
  if (key == OrderKey::direction_origin) return 24;
  return 3 * static_cast<uint32_t>(std::bit_width(bins - 1));
}

}  // namespace

OrderKeys::OrderKeys(gpu::Context& context, OrderKey key, uint32_t bins, const LaunchDirections& directions,
                     float extent_m, std::shared_ptr<const LaunchHeights> heights)
    : directions_(directions),
      heights_(heights ? std::move(heights) : std::make_shared<const LaunchHeights>(context)),
      bins_(bins),
      launch_bits_(key == OrderKey::direction_origin ? 16 : bits_of(key, bins)),
      queue_bits_(bits_of(key, bins)),
      work_(tuning_of(context.info()).order_keys),
      to_unit_(extent_m > 0 ? 1 / extent_m : 0) {
  if (bins < 1 || bins > 1024) throw std::invalid_argument("order_keys: 1 to 1024 bins, not " + std::to_string(bins));
  gpu::Definitions definitions = directions.definitions();
  definitions["WT_LAUNCH_KEY"] = key == OrderKey::direction_origin ? "wt_key_direction" : function_of(key);
  definitions["WT_QUEUE_KEY"] = function_of(key);
  launch_keys_ = {context, definitions};
  queue_keys_ = {context, definitions};
}

void OrderKeys::operator()(uint64_t first, uint32_t count, gpu::Buffer<uint32_t>& keys, uint32_t heights, bool window) {
  launch_keys_(work_.range(count), Stage::order,
               calls::order_keys::launch_keys{.keys = keys,
                                              .count = count,
                                              .first_index = first,
                                              .map = directions_.arguments(),
                                              .heights = heights_->tables(),
                                              .table = heights_->place(heights),
                                              .window = window ? 1u : 0u,
                                              .bins = bins_});
}

void OrderKeys::operator()(const RayQueue& rays, gpu::Buffer<uint32_t>& keys) {
  queue_keys_(work_.range(rays.count), Stage::order,
              calls::order_keys::queue_keys{.rays = rays.planes,
                                            .capacity = rays.capacity,
                                            .count = rays.count,
                                            .to_unit = to_unit_,
                                            .keys = keys,
                                            .bins = bins_});
}

}  // namespace wavetracer
