// SPDX-License-Identifier: Apache-2.0
// Receivers at measured places, and the links of measured points.
#pragma once
#include <string>
#include <vector>
#include "calibration/measured.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer::calibration {

// Replaces the receivers of the configuration by the measured places, and returns the link of each point of all files.
// Points with the same place, antenna and orientation are one receiver. A row takes its antenna, orientation and, where
// the file has none, its height from the [[receiver]] that its column rx names, or from the only one; its own yaw,
// pitch and roll replace those of that orientation. Also switches off what a fit cannot use. file: the name of the
// configuration, for errors. Throws ConfigError or InputError if configuration and files do not fit together.
std::vector<Link> place_receivers(Config& config, const std::string& file, const std::vector<MeasuredFile>& files);

}  // namespace wavetracer::calibration
