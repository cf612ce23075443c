// generate_rays: launch rays of one transmitter into a queue; launch index to direction is a pure function.
// In launch order, or in an order given as a list of launch indices.
#pragma once
#include <glm/vec3.hpp>

#include "passes/launch_directions.hpp"
#include "passes/ray_queue.hpp"
#include "passes/sample_list.hpp"

namespace wavetracer {

// A transmitter that launches.
struct Launcher {
  uint32_t transmitter;
  glm::dvec3 position_m;      // recentred
  uint32_t source = WT_NONE;  // what its rays leave: WT_OWN and the number of the instance that carries it
};

// A rotation of all directions about z.
struct Turn {
  float cosine = 1, sine = 0;
};

class GenerateRays {
 public:
  GenerateRays(gpu::Context& context, const LaunchDirections& directions);
  // Appends the launch indices first, first + stride, ..., `count` of them, of transmitter `index` at `origin`
  // (recentred metres). source: WT_OWN and the number of the instance that carries the antenna, or WT_NONE.
  void operator()(RayQueue& queue, uint32_t index, glm::dvec3 origin, uint64_t first, uint32_t count,
                  uint64_t stride = 1, uint32_t source = WT_NONE);
  // Appends the launch indices first + order[0 .. count - 1]. order has 16 elements more, of any value.
  void operator()(RayQueue& queue, uint32_t index, glm::dvec3 origin, uint64_t first, uint32_t count,
                  const gpu::Buffer<uint32_t>& order, uint32_t source = WT_NONE);

  // Fills the empty queue, which has the plane of samples, with samples first .. first + count - 1 of the list, and
  // sets their ends to the roots. launchers: two float4 each, see the kernel.
  void samples(RayQueue& queue, SampleList& list, uint32_t first, uint32_t count, const gpu::Buffer<float>& launchers,
               const LaunchDirections& directions, Turn turn = {});

 private:
  gpu::Kernel generate_, generate_ordered_, generate_samples_;
  LaunchDirections directions_;
  uint32_t rays_per_item_, local_;
};

}  // namespace wavetracer
