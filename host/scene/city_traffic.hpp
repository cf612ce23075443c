// The traffic of a generated city: one text of options serves scene.generate and trajectories.generate.
// Assumes nothing of the scene itself: vehicles drive on the streets of a city of the same options.
#pragma once
#include <string_view>

#include "motion/traffic.hpp"

namespace wavetracer {

// The options of parse_city_options(), and "--vehicles 20 --seconds 10 --step 0.1", each optional. Throws ConfigError.
TrafficOptions parse_traffic_options(std::string_view text);

inline Trajectories generate_traffic(std::string_view options) {
  return generate_traffic(parse_traffic_options(options));
}

}  // namespace wavetracer
