// SPDX-License-Identifier: Apache-2.0
// The carriers of a configuration.
#pragma once
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer {

// Returns at least one carrier; that of radio.frequency_hz is the first. Throws ConfigError where radio.frequencies_hz
// begins with another one.
std::vector<double> carriers_hz(const RadioConfig& radio);

}  // namespace wavetracer
