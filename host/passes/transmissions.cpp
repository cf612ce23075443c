// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/transmissions.cl.
// One path per work-item.
#include "passes/transmissions.hpp"
#include <algorithm>
#include "wavetracer/device/arguments.h"

namespace wavetracer {

Transmissions::Transmissions(gpu::Context& context, const DeviceScene& scene, uint32_t most, uint32_t deepest)
    : most_(most),
      deepest_(deepest),
      work_(tuning_of(context.info()).exact),
      kernel_(context.kernel("transmissions", "transmissions", scene.definitions)) {}

void Transmissions::operator()(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved, Counters& counters,
                               const StepTables& steps) {
  kernel_(work_.range(solved.count), Stage::transmissions, scene.leg_nodes(), scene.leg_leaves(), scene.moving,
          ends.transmitters, ends.receivers, scene.exact_surfaces, scene.exact_triangles, scene.surfaces,
          solved.headers, solved.vertices, solved.sequences, steps.wedges, steps.surface_of_tile, counters.buffer(),
          wt_legs_arguments{.triangle_slots = scene.triangle_slots,
                            .extent_m = scene.extent_m,
                            .solved_count = solved.count,
                            .solved_counter = solved.counter,
                            .max_depth = solved.max_depth,
                            .most = most_,
                            .deepest = std::min(deepest_, solved.max_depth),
                            .blocker_mask = 0,
                            .tile_count = steps.tile_count(),
                            .first_leg = 0});
}

}  // namespace wavetracer
