// SPDX-License-Identifier: Apache-2.0
// The moving world: vehicles, radio ends and links of every frame, from configuration and trajectories.
// A world without trajectories has one frame, at 0 s. A live world ([[live_vehicle]]) has that frame, without
// vehicles, and frames of poses that come at run time.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "motion/frame_clock.hpp"
#include "simulation/live_places.hpp"
#include "simulation/world_ends.hpp"
#include "simulation/world_fleet.hpp"
#include "simulation/world_links.hpp"
#include "simulation/world_targets.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/live.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// Everything about a drive that is the same in all of its frames. Nothing of it refers to what it was made of.
struct World {
  std::optional<LivePlaces> live;  // set where the configuration has a [[live_vehicle]]
  Fleet fleet;
  GroundBelow ground;
  // All radio ends of all frames: those of the configuration, then those mounted on vehicles, by track, then by mount.
  EndsOfRole transmitters, receivers;
  Targets targets;
  TwinEnds twins;
  LinkRules links;
  FrameClock clock;
  double reach_m;  // no recentred coordinate of an end or of a corner of an instance is larger, in any frame
  std::vector<std::string> warnings;
  // The state of a world in which nothing moves, at 0 s: neither a drive nor a live world.
  std::optional<WorldState> resting = {};

  // The world at the time of a frame. Vehicles that are absent, and their antennas, are where they were last or will be
  // first. Throws ConfigError for a frame that there is not.
  WorldState state(uint64_t frame) const;
  // The world at any time of the drive.
  WorldState at(double time_s) const;
  // The live world with these vehicles in their places.
  WorldState state(double time_s, const std::vector<PlacedPose>& placed) const;
  // Returns the names of ends and instances for these poses.
  LiveNames names(const std::vector<PlacedPose>& placed) const;
  // Throws ConfigError where the world is not live.
  const LivePlaces& live_places() const;
};

// scene: the static one; only its origin, extent and numbers of surfaces and wedges are used, and its triangles where a
// height is measured from the ground. Throws ConfigError or InputError.
World make_world(const Config& config, const Scene& scene);

}  // namespace wavetracer
