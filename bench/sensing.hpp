// SPDX-License-Identifier: Apache-2.0
// Measures a drive whose vehicles are targets of sensing, without targets, with them, and with a floor. The machine
// must be quiet.
#pragma once
#include <cstdint>
#include <string>

#include "wavetracer/config.hpp"

namespace wavetracer::bench {

// config: a drive with antennas on all vehicles and without targets; all vehicles become targets of five points, with
// one mirror before a point and one after it. Prints a line for each setting, first with a radar on one vehicle alone:
// median seconds of a warm frame, compared with that without targets. The error of a floor is the share that it takes
// of the power over targets in the last frame; the detail has the stages that take most of the time.
void print_sensing(const std::string& name, const Config& config, uint32_t frames, const std::string& device,
                   const std::string& command);

}  // namespace wavetracer::bench
