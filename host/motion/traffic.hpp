// SPDX-License-Identifier: Apache-2.0
// Simulates traffic: vehicles that drive the streets of a generated city, on the right.
// The same options give the same drive on every platform: choices are integers, states change by + - * / and sqrt only.
#pragma once
#include <cstdint>

#include "motion/traffic_streets.hpp"
#include "motion/trajectories.hpp"

namespace wavetracer {

struct TrafficOptions {
  StreetGrid grid{};
  uint64_t seed = 1;
  uint32_t vehicles = 20;
  double duration_s = 10, step_s = 0.1;  // samples at 0, step_s, ... up to duration_s
};

// Simulates vehicles "veh0", "veh1", ... of SUMO's classes passenger (80 %), delivery (12 %) and truck (8 %), all
// present throughout. Each wants to drive 30 to 60 km/h, keeps a safe gap (S. Krauss, 1998, without dawdling), slows
// down for turns and chooses them by chance. Crossings are reserved: a vehicle that would be in another's way waits, in
// order of arrival. So no two vehicles ever touch. They have driven for a while when the drive begins.
// Throws ConfigError if the vehicles do not fit into the streets.
Trajectories generate_traffic(const TrafficOptions& options);

}  // namespace wavetracer
