// What the maps from launch index to direction take (wavetracer/device/directions.h), for kernels that evaluate them.
// Every user of a launch makes the same numbers from the same configuration.
#pragma once
#include <cstdint>
#include <string>

#include "wavetracer/config.hpp"

namespace wavetracer {

struct LaunchDirections {
  // rays: of a launch, for each transmitter, 1 .. 2^31.
  LaunchDirections(Directions directions, uint64_t rays, uint64_t seed)
      : map("wt_direction_" + directions.text()), parameter(directions == "random" ? seed : ~uint64_t{0} / rays) {
    // The fewest cells that suffice: faces of 120 degrees are about square at the horizon, and up to eleven fill the
    // gap to the next level.
    while (uint64_t{12} << (2 * level) < rays) ++level;
    while (uint64_t{faces} << (2 * level) < rays) ++faces;
  }

  std::string map;     // name of the function
  uint64_t parameter;  // its step or seed
  uint32_t level = 0, faces = 3;
};

}  // namespace wavetracer
