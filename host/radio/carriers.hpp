// The carriers of a configuration.
#pragma once
#include <vector>

#include "wavetracer/config.hpp"

namespace wavetracer {

// At least one, that of radio.frequency_hz first. Throws ConfigError where radio.frequencies_hz begins with another
// one.
std::vector<double> carriers_hz(const RadioConfig& radio);

}  // namespace wavetracer
