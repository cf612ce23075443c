// SPDX-License-Identifier: Apache-2.0
// The plan of a frame's launch: the ends that launch rays, and how their directions are spread. It follows from the
// world and the links alone, so a world at rest has one plan for all of its frames.
#pragma once
#include <vector>

#include "simulation/link_block.hpp"
#include "simulation/setup.hpp"

namespace wavetracer {

struct LaunchPlan {
  std::vector<Launcher> transmitters, listeners;
  SlopeTables tables;
  double spread_m2 = 0;  // see DiscoveryCounts
};

// Listeners launch, too, where prefixes of both ends meet at an edge or a tile. block: the links that are solved,
// null for all links of the world, which gives launchers of any block (launchers_of); few: one transmitter and one
// listener at most, for frames that only compile.
LaunchPlan plan_launch(Setup& setup, const WorldState& world, const LinkBlock* block, bool few);

}  // namespace wavetracer
