// SPDX-License-Identifier: Apache-2.0
// The configuration with fitted materials.
#pragma once
#include <span>
#include <string>
#include <vector>
#include "calibration/parameters.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::calibration {

// Reads a configuration whose receivers may be missing: measured places take their part.
Config config_of_places(const std::string& file, const std::vector<std::string>& sets);

// Returns the configuration of the file with the parameters at these values of theta, in [[material]] tables.
Config fitted_config(const std::string& file, const std::vector<std::string>& sets,
                     std::span<const Parameter> parameters, std::span<const double> theta);

}  // namespace wavetracer::calibration
