// SPDX-License-Identifier: Apache-2.0
// The configuration with fitted values.
#pragma once
#include <span>
#include <string>
#include <vector>
#include "calibration/measured_world.hpp"
#include "calibration/parameters.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::calibration {

// Reads a configuration whose receivers may be missing: measured places take their part.
Config config_of_places(const std::string& file, const std::vector<std::string>& sets);

// Returns the configuration with the parameters at their values in `fitted`. A material of which permittivity or
// conductivity is fitted gets both as constants at the carrier, in place of a law over frequency. A transmitter of
// which a coordinate is fitted gets a position in file coordinates, also if it had another form. A rise of the
// receivers is added to the height of a [[receiver]], which places without heights have.
Config fitted_config(Config config, const Inputs& fitted, double frequency_hz, std::span<const Parameter> parameters);

}  // namespace wavetracer::calibration
