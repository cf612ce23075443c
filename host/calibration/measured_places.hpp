// SPDX-License-Identifier: Apache-2.0
// The measured rows as receivers and links of a configuration.
#pragma once
#include <vector>
#include "calibration/measured.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer::calibration {

struct MeasuredPlaces {
  Config config;            // its receivers are the measured places
  std::vector<Link> links;  // a link for each point of all files, one file after the other
};

// Puts receivers at the measured places. config: describes the world, the carrier and the transmitters. A row takes its
// antenna, orientation and, where the file has none, its height from the [[receiver]] that its column rx names, or from
// the only one; its own yaw, pitch and roll replace those of that orientation. Caches and waypoints are switched off.
// Throws ConfigError or InputError where the configuration does not fit the files.
MeasuredPlaces measured_places(Config config, const std::vector<MeasuredFile>& files);

}  // namespace wavetracer::calibration
