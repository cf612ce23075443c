// SPDX-License-Identifier: Apache-2.0
// order_keys: sort keys of rays, by the direction only or by direction and origin; they have 32 bits, of which the
// lowest launch_bits() or queue_bits() count. Keys of launch rays need no rays: they come from the launch indices.
#pragma once
#include <memory>

#include "kernel_calls/order_keys.hpp"
#include "passes/launch_directions.hpp"
#include "passes/launch_heights.hpp"
#include "passes/ray_queue.hpp"
#include "passes/tuning.hpp"
#include "wavetracer/order_methods.hpp"

namespace wavetracer {

// morton: Z-order of the direction's cells, 1,024 for each component. morton_bins, hilbert_bins: a histogram of
// directions, whose bins are visited along a Morton or a 3D Hilbert curve (A. Zhdanov, 2014, algorithm 1).
// direction_origin: 4,096 cells of directions, and in each 16^3 cells of the scene; at launch all rays have one origin,
// and there are 2^16 cells of directions.
class OrderKeys {
 public:
  // bins: number for each direction component, 1 .. 1024, for the histograms. extent_m: the largest absolute coordinate
  // of origins. heights: those of the generate_rays of this launch.
  OrderKeys(gpu::Context& context, OrderKey key, uint32_t bins, const LaunchDirections& directions, float extent_m,
            std::shared_ptr<const LaunchHeights> heights = {});
  // The number of bits of the keys of launches, and of queues.
  uint32_t launch_bits() const { return launch_bits_; }
  uint32_t queue_bits() const { return queue_bits_; }
  // Computes the keys of the launch indices first .. first + count - 1 of a launcher with this table of heights, which
  // may be a window. keys has 16 further elements, which may be overwritten.
  void operator()(uint64_t first, uint32_t count, gpu::Buffer<uint32_t>& keys, uint32_t heights = 0,
                  bool window = false);
  // Computes the keys of the rays of a queue; keys has 16 further elements, too.
  void operator()(const RayQueue& rays, gpu::Buffer<uint32_t>& keys);

 private:
  gpu::KernelOf<calls::order_keys::launch_keys> launch_keys_;
  gpu::KernelOf<calls::order_keys::queue_keys> queue_keys_;
  LaunchDirections directions_;
  std::shared_ptr<const LaunchHeights> heights_;
  uint32_t bins_, launch_bits_, queue_bits_;
  Work work_;
  float to_unit_;
};

}  // namespace wavetracer
