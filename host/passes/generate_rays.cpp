// Host side of kernels/generate_rays.cl.
// Assumes the queue has room: the frame loop sizes its batches.
#include "passes/generate_rays.hpp"

#include <stdexcept>

namespace wavetracer {

GenerateRays::GenerateRays(gpu::Context& context, const std::string& directions, uint64_t rays, uint64_t seed)
    : kernel_(context.kernel("generate_rays", "generate_rays", {{"WT_DIRECTIONS", "wt_direction_" + directions}})),
      parameter_(directions == "random" ? seed : ~uint64_t{0} / rays),
      rays_per_item_(context.info().cpu ? 16 : 1) {
  // The fewest cells that suffice: faces of 120 degrees are about square at the horizon, and up to eleven fill the gap
  // to the next level.
  while (uint64_t{12} << (2 * level_) < rays) ++level_;
  while (uint64_t{faces_} << (2 * level_) < rays) ++faces_;
}

void GenerateRays::operator()(RayQueue& queue, uint32_t index, glm::dvec3 origin, uint64_t first, uint32_t count) {
  if (uint64_t{queue.count} + count + 16 > queue.capacity) throw std::logic_error("generate_rays: the queue is full");
  kernel_({(count + rays_per_item_ - 1) / rays_per_item_, 64}, "generate_rays", queue.planes, queue.capacity,
          queue.count, count, first, parameter_, level_, faces_, static_cast<float>(origin.x),
          static_cast<float>(origin.y), static_cast<float>(origin.z), WT_ROOT | index);
  queue.count += count;
}

}  // namespace wavetracer
