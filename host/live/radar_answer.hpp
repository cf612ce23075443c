// SPDX-License-Identifier: Apache-2.0
// The radars of an answer: what is said of each link, in the same order in both encodings.
#pragma once
#include <array>
#include <vector>

#include "live/json_line.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/live.hpp"
#include "wavetracer/radar.hpp"

namespace wavetracer::live {

struct RadarAnswer {
  const Config& config;
  const std::vector<RadarAxes>& axes;  // one for each [[radar]]
  const std::vector<RadarRows>& rows;  // the same; none: the answer says nothing of radars
  bool cubes = false;                  // with cubes and their axes

  size_t row_count() const {
    size_t out = 0;
    for (const RadarRows& each : rows) out += each.size();
    return out;
  }
};

struct DetectionKey {
  const char* name;
  std::vector<double> RadarDetections::*column;
};
inline constexpr std::array detection_keys{DetectionKey{"range_m", &RadarDetections::range_m},
                                           DetectionKey{"delay_s", &RadarDetections::delay_s},
                                           DetectionKey{"speed_m_s", &RadarDetections::speed_m_s},
                                           DetectionKey{"doppler_hz", &RadarDetections::doppler_hz},
                                           DetectionKey{"power_dbm", &RadarDetections::power_dbm},
                                           DetectionKey{"threshold_dbm", &RadarDetections::threshold_dbm},
                                           DetectionKey{"azimuth_rad", &RadarDetections::azimuth_rad},
                                           DetectionKey{"elevation_rad", &RadarDetections::elevation_rad}};

// Writes the key "radars" with an object for each link of each radar.
void write_radars(Line& line, const LiveFrame& frame, const RadarAnswer& radars);

}  // namespace wavetracer::live
