// SPDX-License-Identifier: Apache-2.0
// The times at which a world of moving vehicles is solved, by its configuration and its trajectories.
#pragma once
#include <string>
#include <vector>

#include "motion/frame_clock.hpp"
#include "simulation/world_trajectories.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// The frames of [time]: numbers that it leaves out are those of the trajectories, of which there is at least one.
// Throws ConfigError where no frame would have a vehicle, and where no step is known.
FrameClock make_clock(const TimeConfig& config, const Trajectories& trajectories);

// A warning if frames of that clock have no vehicle; empty if all have one.
std::vector<std::string> empty_frames_warning(const TimeConfig& config, const Trajectories& trajectories,
                                              const FrameClock& clock);

}  // namespace wavetracer
