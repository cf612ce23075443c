// SPDX-License-Identifier: Apache-2.0
// Discovery by beams in a frame, in place of a launch of rays.
#include <algorithm>
#include <iterator>

#include "simulation/frame.hpp"
#include "simulation/launch_share.hpp"
#include "simulation/tracing_depth.hpp"

namespace wavetracer {

DiscoveryCounts FrameLoop::follow_beams(const FrameTask& task, const WorldState& world, const LinkBlock* block) {
  std::vector<Launcher> ends = sending(world);
  if (plan_.trace.from_both_ends()) std::ranges::copy(listening(world, plan_.origins), std::back_inserter(ends));
  if (block) ends = launchers_of(*block, ends);
  const Fleet& fleet = plan_.world.fleet;
  if (!fleet.instances.empty()) s_.beams->set_world(fleet.instances, world.instances);
  const uint32_t depth = tracing_depth(plan_.trace).sequences;
  BeamTask beams{.standing = {},
                 .moving = {},
                 .max_depth = task.only_compiles() ? std::min(depth, 2u) : depth,
                 .keep = plan_.keep_beams || (task.links().is_batch() && !plan_.trace.from_both_ends())};
  for (const Launcher& end : ends) (standing_origins_[end.transmitter] ? beams.standing : beams.moving).push_back(end);
  for (const EndState& end : world.receivers)
    if (end.present) beams.receivers.push_back(end.position_m);
  DiscoveryCounts out;
  // beam_moving, beam_gather, beam_visible
  out.beams = s_.beams->find(s_.device_scene, beams, s_.discovery->sequences());
  return out;
}

}  // namespace wavetracer
