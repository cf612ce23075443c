// generate_rays: launch rays of one transmitter into a queue; launch index to direction is a pure function.
// Directions: hilbert (equal-area cells in the order of a Hilbert curve), fibonacci, random.
#pragma once
#include <glm/vec3.hpp>
#include <string>

#include "passes/ray_queue.hpp"

namespace wavetracer {

class GenerateRays {
 public:
  // rays: launch rays a transmitter, 1 .. 2^31.
  GenerateRays(gpu::Context& context, const std::string& directions, uint64_t rays, uint64_t seed);
  // Appends the launch indices first .. first + count - 1 of transmitter `index` at `origin` (recentred metres).
  void operator()(RayQueue& queue, uint32_t index, glm::dvec3 origin, uint64_t first, uint32_t count);

 private:
  gpu::Kernel kernel_;
  uint64_t parameter_;
  uint32_t level_ = 0, faces_ = 3;
  uint32_t rays_per_item_;
};

}  // namespace wavetracer
