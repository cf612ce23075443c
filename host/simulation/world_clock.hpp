// The times at which a world of moving vehicles is solved, by its configuration and its trajectories.
#pragma once
#include <string>
#include <vector>

#include "motion/frame_clock.hpp"
#include "simulation/world_trajectories.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// The frames of [time]: numbers that it leaves out are those of the trajectories, of which there is at least one. Adds
// a warning where frames have no vehicle. Throws ConfigError where none would have one, and where no step is known.
FrameClock make_clock(const TimeConfig& config, const Trajectories& trajectories, std::vector<std::string>& warnings);

}  // namespace wavetracer
