// Host side of kernels/transmissions.cl.
// One path a work-item.
#include "passes/transmissions.hpp"

namespace wavetracer {

Transmissions::Transmissions(gpu::Context& context, const DeviceScene& scene, uint32_t most) : most_(most) {
  gpu::Definitions definitions = scene.definitions;
  definitions[scene.cpu ? "WT_SHAPE_BVH8" : "WT_SHAPE_BVH2"] = "1";
  kernel_ = context.kernel("transmissions", "transmissions", definitions);
}

void Transmissions::operator()(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved) {
  kernel_({solved.count, 16}, "transmissions", scene.cpu ? scene.nodes8 : scene.nodes2,
          scene.cpu ? scene.blocks8 : scene.triangles2, scene.triangle_slots, scene.extent_m, scene.moving,
          ends.transmitters, ends.receivers, scene.exact_surfaces, scene.surfaces, solved.count, solved.max_depth,
          most_, solved.headers, solved.vertices, solved.sequences);
}

}  // namespace wavetracer
