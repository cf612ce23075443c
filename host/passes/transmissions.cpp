// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/transmissions.cl.
// One path per work-item.
#include "passes/transmissions.hpp"
#include <algorithm>
#include "passes/legs_arguments.hpp"

namespace wavetracer {

Transmissions::Transmissions(gpu::Context& context, const DeviceScene& scene, uint32_t most, uint32_t deepest)
    : most_(most), deepest_(deepest), work_(tuning_of(context.info()).exact), kernel_(context, scene.definitions) {}

void Transmissions::operator()(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved, Counters& counters,
                               const StepTables& steps) {
  wt_legs_arguments args = legs_arguments(scene, solved, steps);
  args.most = most_;
  args.deepest = std::min(deepest_, solved.max_depth);
  kernel_(work_.range(solved.count), Stage::transmissions,
          calls::transmissions::transmissions{.nodes = scene.leg_nodes(),
                                              .triangles = scene.leg_leaves(),
                                              .moving = scene.moving,
                                              .transmitters = ends.transmitters,
                                              .receivers = ends.receivers,
                                              .surfaces = scene.exact_surfaces,
                                              .corners = scene.exact_triangles,
                                              .boxes = scene.surfaces,
                                              .solved = solved.headers,
                                              .vertices = solved.vertices,
                                              .sequences = solved.sequences,
                                              .wedges = steps.wedges,
                                              .surface_of_tile = steps.surface_of_tile,
                                              .targets = steps.targets,
                                              .counters = counters.buffer(),
                                              .args = args});
}

}  // namespace wavetracer
