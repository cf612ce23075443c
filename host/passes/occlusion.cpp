// Host side of kernels/occlusion.cl.
// One leg a work-item.
#include "passes/occlusion.hpp"

namespace wavetracer {

Occlusion::Occlusion(gpu::Context& context, const DeviceScene& scene) {
  gpu::Definitions definitions = scene.definitions;
  definitions[scene.cpu ? "WT_SHAPE_BVH8" : "WT_SHAPE_BVH2"] = "1";
  kernel_ = context.kernel("occlusion", "occlusion", definitions);
}

void Occlusion::operator()(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved) {
  kernel_({size_t{solved.count} * (solved.max_depth + 1), 16}, "occlusion", scene.cpu ? scene.nodes8 : scene.nodes2,
          scene.cpu ? scene.blocks8 : scene.triangles2, scene.triangle_slots, scene.extent_m, scene.moving,
          ends.transmitters, ends.receivers, scene.exact_surfaces, solved.count, solved.max_depth, solved.headers,
          solved.vertices, solved.sequences);
}

}  // namespace wavetracer
