// SPDX-License-Identifier: Apache-2.0
// The whole world decides on slopes and sides, so that a block of links launches as the frame of all links does.
#include "simulation/launch_plan.hpp"

#include <algorithm>

#include "simulation/launch_spacing.hpp"

namespace wavetracer {

LaunchPlan plan_launch(Setup& setup, const WorldState& world, const LinkBlock* block, bool few) {
  const Origins& origins = setup.plan->origins;
  LaunchPlan out;
  out.transmitters = sending(world);
  if (setup.plan->trace.from_both_ends()) out.listeners = listening(world, origins);
  if (setup.slopes) out.tables = setup.slopes->tables(world, origins);
  for (std::vector<Launcher>* const ends : {&out.transmitters, &out.listeners}) {
    if (block) *ends = launchers_of(*block, *ends);
    if (few) ends->resize(std::min<size_t>(ends->size(), 1));
    if (!setup.trails) *ends = setup.launch_sides.of(*ends, world);  // trails follow one launch of each transmitter
    for (Launcher& launcher : *ends)
      if (setup.slopes) launcher.heights = out.tables.of_origin[launcher.transmitter];
    if (setup.windows) *ends = setup.windows->of(*ends, world, out.tables);
  }
  out.spread_m2 = widest_spread_m2(out.transmitters, out.tables.values, setup.slopes.has_value(),
                                   block ? block->solved : world.links, world.receivers);
  return out;
}

}  // namespace wavetracer
