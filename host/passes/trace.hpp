// trace: nearest hits of a queue of rays, and the hits of every block of rays.
// Equal distances go to the lower primitive, so shapes, devices and trees all give the same hits.
#pragma once
#include "passes/device_scene.hpp"
#include "passes/ray_queue.hpp"

namespace wavetracer {

class Trace {
 public:
  // Rays a block: the unit in which hits are counted and rays compacted.
  static uint32_t block_size(const gpu::DeviceInfo& device) { return device.cpu ? 16 : 128; }

  Trace(gpu::Context& context, const DeviceScene& scene, TraceShape shape);
  void operator()(const DeviceScene& scene, const RayQueue& rays, HitList& hits);

 private:
  gpu::Kernel kernel_;
  TraceShape shape_;
  uint32_t block_;
};

}  // namespace wavetracer
