// Host side of kernels/transmissions.cl.
// One path a work-item.
#include "passes/transmissions.hpp"

namespace wavetracer {

Transmissions::Transmissions(gpu::Context& context, const DeviceScene& scene, uint32_t most)
    : most_(most),
      work_(tuning_of(context.info()).exact),
      kernel_(context.kernel("transmissions", "transmissions", scene.definitions)) {}

void Transmissions::operator()(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved) {
  kernel_(work_.range(solved.count), "transmissions", scene.leg_nodes(), scene.leg_leaves(), scene.triangle_slots,
          scene.extent_m, scene.moving, ends.transmitters, ends.receivers, scene.exact_surfaces, scene.surfaces,
          solved.count, solved.max_depth, most_, solved.headers, solved.vertices, solved.sequences);
}

}  // namespace wavetracer
