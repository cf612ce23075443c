// SPDX-License-Identifier: Apache-2.0
// The constants of the maps from launch index to direction (wavetracer/device/directions.h), for kernels that evaluate
// them. Every user of a launch derives the same numbers from the same configuration.
#pragma once
#include <cstdint>
#include <string>

#include "gpu/gpu.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/device/arguments.h"

namespace wavetracer {

struct LaunchDirections {
  // rays: those of a launch, for each transmitter, 1 .. 2^31.
  LaunchDirections(Directions directions, uint64_t rays, uint64_t seed)
      : by_table(by_slopes(directions)),
        places("wt_place_" + (by_table ? "hilbert" : directions.text())),
        parameter(at_random(directions) ? seed : ~uint64_t{0} / rays) {
    // This takes the fewest cells that suffice: faces of 120 degrees are about square at the horizon, and up to eleven
    // fill the gap to the next level.
    while (uint64_t{12} << (2 * level) < rays) ++level;
    while (uint64_t{faces} << (2 * level) < rays) ++faces;
  }

  // Definitions for kernels that evaluate the map.
  gpu::Definitions definitions() const { return {{"WT_PLACES", places}, {"WT_BY_TABLE", by_table ? "1" : "0"}}; }

  bool by_table;       // heights are spread by a table
  std::string places;  // the name of the function that gives places on the cylinder
  uint64_t parameter;  // its step or seed
  uint32_t level = 0, faces = 3;

  wt_map_arguments arguments() const { return {parameter, level, faces}; }
};

}  // namespace wavetracer
