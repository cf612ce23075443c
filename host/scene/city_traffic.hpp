// SPDX-License-Identifier: Apache-2.0
// Options of a generated city's traffic: one text of options serves scene.generate and trajectories.generate.
// Vehicles drive on the streets of a city with the same options.
#pragma once
#include <string_view>

#include "motion/traffic.hpp"

namespace wavetracer {

// Parses the options of parse_city_options() and "--vehicles 20 --seconds 10 --step 0.1"; each is optional. Throws
// ConfigError.
TrafficOptions parse_traffic_options(std::string_view text);

inline Trajectories generate_traffic(std::string_view options) {
  return generate_traffic(parse_traffic_options(options));
}

}  // namespace wavetracer
