// SPDX-License-Identifier: Apache-2.0
// Scenes with antennas in their streets, the same for every benchmark that solves whole frames.
// Streets are at z = 0 of the file's coordinates.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer::bench {

struct Place {
  std::string name;
  SceneConfig scene;
  std::vector<RadioEnd> transmitters, receivers;  // at the height of cars; the first receiver is the nearest one
};

// Returns shared/scenes/munich with antennas around a street crossing; nothing if it is missing.
std::optional<Place> munich_place(const std::string& shared, size_t transmitters, size_t receivers);
// Returns the generated city in the same way.
Place city_place(size_t transmitters, size_t receivers);

// Returns the scene and the first ends of a place at 5.9 GHz, with defaults for all other keys.
Config config_of(const Place& place, size_t transmitters, size_t receivers);

}  // namespace wavetracer::bench
