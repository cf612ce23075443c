// SPDX-License-Identifier: Apache-2.0
// Orders of rays: the plan that the configuration asks for, and the sorting that follows it, at launch and before later
// depths. Only the time of a frame depends on them, not its result.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "passes/gather_rays.hpp"
#include "passes/generate_rays.hpp"
#include "passes/launch_shape.hpp"
#include "passes/order_keys.hpp"
#include "passes/sort.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/order_methods.hpp"

namespace wavetracer {

// An order in which "auto" and other names are resolved.
struct OrderPlan {
  std::string method = "none";  // a plain name
  std::optional<OrderKey> key;  // not set: rays keep the order of their launch
  bool each_depth = false;
  uint32_t bins = 16;
  LaunchShape launch;
};

// Throws ConfigError for a method that does not fit the shape; "auto" is not a plan (see order_choice.hpp).
OrderPlan plan_order(const OrderConfig& order, const LaunchConfig& launch);

class RayOrder {
 public:
  // extent_m: the largest absolute coordinate of scene and rays.
  RayOrder(gpu::Context& context, OrderKey key, uint32_t bins, const LaunchDirections& directions, float extent_m,
           std::shared_ptr<const LaunchHeights> heights);
  // Makes room for launches and queues of this many rays.
  void reserve(uint64_t rays);
  // Returns the launch indices first .. first + count - 1 of this launcher in their order, minus first. Valid until the
  // next call.
  const gpu::Buffer<uint32_t>& sort_launch(uint64_t first, uint32_t count, const Launcher& from);
  // Sorts the queue; spare has the same capacity and is overwritten.
  void sort_queue(RayQueue& rays, RayQueue& spare);

 private:
  void check_room(uint64_t rays) const;

  gpu::Context& context_;
  OrderKeys keys_of_;
  Sort sort_;
  GatherRays gather_;
  gpu::Buffer<uint32_t> keys_, order_;
};

}  // namespace wavetracer
