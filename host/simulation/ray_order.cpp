// SPDX-License-Identifier: Apache-2.0
// Makes the plan of an order, and joins keys, sort and gather in one call. Launches are sorted before their rays exist:
// generate_rays then writes them in order, and no ray has to be moved.
#include "simulation/ray_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include "wavetracer/error.hpp"

namespace wavetracer {

OrderPlan plan_order(const OrderConfig& order, const LaunchConfig& launch) {
  const std::optional<OrderMethodRow> method = find_order_method(order.method);
  if (!method) throw std::logic_error("plan_order: order.method = \"auto\" is chosen by choose_order");
  auto dimensions = static_cast<unsigned>(launch.shape.index());  // 0: auto
  if (dimensions == 0) dimensions = std::max(method->launch_dimensions, 1u);
  if (method->launch_dimensions > 0 && dimensions != method->launch_dimensions)
    throw ConfigError(fmt::format("order.method = \"{}\" cannot be used with launch.shape = \"{}\"",
                                  order.method.word(), launch.shape.word()));
  if (launch.local_size && (*launch.local_size > 1024 || !std::has_single_bit(*launch.local_size)))
    throw ConfigError(fmt::format("launch.local_size = {} is not a power of two up to 1024", *launch.local_size));
  return {method->name.text(),
          method->key,
          order.each_depth && method->key,
          order.bin_num,
          {dimensions, method->launch_dimensions > 0, launch.local_size}};
}

RayOrder::RayOrder(gpu::Context& context, OrderKey key, uint32_t bins, const LaunchDirections& directions,
                   float extent_m, std::shared_ptr<const LaunchHeights> heights)
    : context_(context),
      keys_of_(context, key, bins, directions, extent_m, std::move(heights)),
      sort_(context),
      gather_(context) {}

void RayOrder::reserve(uint64_t rays) {
  order_ = context_.buffer<uint32_t>(rays + 16, "order");
  sort_.reserve(static_cast<uint32_t>(rays));
  keys_ = context_.buffer<uint32_t>(rays + 16, "order keys");  // last, since its size is the room that there is
}

void RayOrder::check_room(uint64_t rays) const {
  if (rays + 16 > keys_.size()) throw std::logic_error("ray_order: no room for the rays");
}

const gpu::Buffer<uint32_t>& RayOrder::sort_launch(uint64_t first, uint32_t count, const Launcher& from) {
  check_room(count);
  keys_of_(first, count, keys_, from.heights, from.window);
  sort_(keys_, order_, count, keys_of_.launch_bits());
  return order_;
}

void RayOrder::sort_queue(RayQueue& rays, RayQueue& spare) {
  check_room(rays.count);
  keys_of_(rays, keys_);
  sort_(keys_, order_, rays.count, keys_of_.queue_bits());
  gather_(rays, order_, rays.count, spare);
  std::swap(rays, spare);
}

}  // namespace wavetracer
