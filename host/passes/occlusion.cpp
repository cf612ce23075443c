// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/paths/occlusion.cl.
// First legs are tested first, then all others. On CPUs a work-item tests the legs of 16 paths, one number after the
// other, where nothing moves: packets do not go through the trees of instances.
#include "passes/occlusion.hpp"
#include <algorithm>
#include <string>
#include "passes/legs_arguments.hpp"

namespace wavetracer {
namespace {

// Packets of a work-item on CPUs, and paths of a packet (WT_SHARING of the kernel).
constexpr uint32_t packets_together = 8, paths_of_packet = 16;

bool in_packets(const gpu::DeviceInfo& device, const DeviceScene& scene) {
  return device.cpu && !scene.definitions.contains("WT_INSTANCES");
}

gpu::Definitions build_of(const gpu::DeviceInfo& device, const DeviceScene& scene) {
  gpu::Definitions out = scene.definitions;
  if (const uint32_t most = path_tuning_of(device).leg_registers; most > 0)
    out["-cl-nv-maxrregcount"] = std::to_string(most);
  if (in_packets(device, scene)) out["WT_PACKETS"] = std::to_string(packets_together) + "u";
  return out;
}

}  // namespace

Occlusion::Occlusion(gpu::Context& context, const DeviceScene& scene)
    : work_(tuning_of(context.info()).exact),
      packets_(in_packets(context.info(), scene)),
      kernel_(context, build_of(context.info(), scene)) {}

void Occlusion::operator()(const DeviceScene& scene, const RadioEnds& ends, SolvedList& solved, Counters& counters,
                           Blockers* blockers, const StepTables& steps) {
  const auto test = [&](uint32_t first_leg, const gpu::Range& range) {
    wt_legs_arguments args = legs_arguments(scene, solved, steps);
    args.blocker_mask = Blockers::mask;
    args.first_leg = first_leg;
    calls::occlusion::occlusion call{.nodes = scene.leg_nodes(),
                                     .triangles = scene.leg_leaves(),
                                     .moving = scene.moving,
                                     .transmitters = ends.transmitters,
                                     .receivers = ends.receivers,
                                     .surfaces = scene.exact_surfaces,
                                     .corners = scene.exact_triangles,
                                     .solved = solved.headers,
                                     .vertices = solved.vertices,
                                     .sequences = solved.sequences,
                                     .wedges = steps.wedges,
                                     .surface_of_tile = steps.surface_of_tile,
                                     .targets = steps.targets,
                                     .blockers = blockers ? &blockers->places : nullptr,
                                     .counters = counters.buffer(),
                                     .args = args};
    if (packets_) {
      call.packet_nodes = scene.packet_nodes2;
      call.packet_triangles = scene.triangles2;
    }
    kernel_(range, Stage::occlusion, call);
  };
  constexpr uint32_t paths_together = packets_together * paths_of_packet;
  if (packets_) return test(0, {(size_t{solved.count} + paths_together - 1) / paths_together, 1});
  const auto legs = [&](size_t count) { return gpu::Range({solved.count, count, 1}, {work_.group, 1, 1}, 2); };
  test(0, legs(1));
  test(1, legs(std::min(solved.max_depth, solved.deepest)));
}

}  // namespace wavetracer
