// SPDX-License-Identifier: Apache-2.0
// The radars of a world: which links each [[radar]] takes, and the axes of its maps.
#pragma once
#include <string>
#include <vector>

#include "simulation/world.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/radar.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct WorldRadar {
  RadarAxes axes;
  std::vector<Link> links;  // those that it takes where they are in a frame, sorted
};

// In the order of config.radars. config: with all ends of the world. Throws ConfigError for a radar that has no link,
// with the key that would allow one, or whose cubes would be too large, and for links of unlike antennas. Warns of
// pairs that [links] leaves out.
std::vector<WorldRadar> world_radars(const Config& config, const World& world, std::vector<std::string>& warnings);

// Those of a radar's links that are in a frame, sorted. Both lists are sorted.
std::vector<Link> links_in(const WorldRadar& radar, const std::vector<Link>& present);

}  // namespace wavetracer
