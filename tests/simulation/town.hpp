// SPDX-License-Identifier: Apache-2.0
// A small generated town with two transmitters and five receivers, or with vehicles that listen.
#pragma once
#include "simulation/run.hpp"

namespace wavetracer::test {

inline Config small_town(uint64_t rays, uint32_t max_depth) {
  Config config = config_of("", {{0, 0, 12}, {100, 3, 2}},
                            {{60, -2, 1.5}, {-97, 4, 1.5}, {40, 7, 1.5}, {-3, -50, 5}, {103, 50, 2}}, rays, max_depth);
  config.scene.generate = "--blocks 4x4";
  return config;
}

// Replaces the receivers by antennas on the roofs of 20 vehicles that drive for a second.
inline void let_vehicles_hear(Config& config) {
  config.receivers.clear();
  config.trajectories.generate = "--seed 1 --vehicles 20 --seconds 1 --step 0.1";
  for (const char* type : {"passenger", "delivery", "truck"})
    config.mounts.push_back({.name = "roof", .on = type, .role = "receiver", .offset_m = {0, 0, 2}});
  config.time.step_s = 0.1;
}

}  // namespace wavetracer::test
