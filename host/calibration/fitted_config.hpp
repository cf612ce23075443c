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

// Returns the configuration with the parameters at these values of theta, in [[material]] tables. A material of which
// permittivity or conductivity is fitted gets both as constants at the carrier, in place of a law over frequency.
// world: the records of the configuration itself.
Config fitted_config(Config config, const NamedRecords& world, std::span<const Parameter> parameters,
                     std::span<const double> theta);

}  // namespace wavetracer::calibration
