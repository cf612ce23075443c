// Host side of kernels/generate_rays.cl.
// Assumes the queue has room: the frame loop sizes its batches.
#include "passes/generate_rays.hpp"

#include <stdexcept>

namespace wavetracer {

namespace {
void check_room(const RayQueue& queue, uint32_t count) {
  if (uint64_t{queue.count} + count + 16 > queue.capacity) throw std::logic_error("generate_rays: the queue is full");
}
}  // namespace

GenerateRays::GenerateRays(gpu::Context& context, const LaunchDirections& directions)
    : generate_(context.kernel("generate_rays", "generate_rays", {{"WT_DIRECTIONS", directions.map}})),
      generate_ordered_(context.kernel("generate_rays", "generate_ordered", {{"WT_DIRECTIONS", directions.map}})),
      directions_(directions),
      rays_per_item_(context.info().cpu ? 16 : 1),
      local_(context.info().simple_local_size()) {}

void GenerateRays::operator()(RayQueue& queue, uint32_t index, glm::dvec3 origin, uint64_t first, uint32_t count) {
  check_room(queue, count);
  generate_({(count + rays_per_item_ - 1) / rays_per_item_, local_}, "generate_rays", queue.planes, queue.capacity,
            queue.count, count, first, directions_.parameter, directions_.level, directions_.faces,
            static_cast<float>(origin.x), static_cast<float>(origin.y), static_cast<float>(origin.z), WT_ROOT | index);
  queue.count += count;
}

void GenerateRays::operator()(RayQueue& queue, uint32_t index, glm::dvec3 origin, uint64_t first, uint32_t count,
                              const gpu::Buffer<uint32_t>& order) {
  check_room(queue, count);
  generate_ordered_({(count + rays_per_item_ - 1) / rays_per_item_, local_}, "generate_rays", queue.planes,
                    queue.capacity, queue.count, count, first, order, directions_.parameter, directions_.level,
                    directions_.faces, static_cast<float>(origin.x), static_cast<float>(origin.y),
                    static_cast<float>(origin.z), WT_ROOT | index);
  queue.count += count;
}

}  // namespace wavetracer
