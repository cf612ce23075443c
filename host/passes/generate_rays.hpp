// generate_rays: launch rays of one transmitter into a queue; launch index to direction is a pure function.
// In launch order, or in an order given as a list of launch indices.
#pragma once
#include <glm/vec3.hpp>

#include "passes/launch_directions.hpp"
#include "passes/ray_queue.hpp"

namespace wavetracer {

class GenerateRays {
 public:
  GenerateRays(gpu::Context& context, const LaunchDirections& directions);
  // Appends the launch indices first .. first + count - 1 of transmitter `index` at `origin` (recentred metres).
  void operator()(RayQueue& queue, uint32_t index, glm::dvec3 origin, uint64_t first, uint32_t count);
  // Appends the launch indices first + order[0 .. count - 1]. order has 16 elements more, of any value.
  void operator()(RayQueue& queue, uint32_t index, glm::dvec3 origin, uint64_t first, uint32_t count,
                  const gpu::Buffer<uint32_t>& order);

 private:
  gpu::Kernel generate_, generate_ordered_;
  LaunchDirections directions_;
  uint32_t rays_per_item_, local_;
};

}  // namespace wavetracer
