// SPDX-License-Identifier: Apache-2.0
// The radars of an answer: what is said of each link, in the same order in both encodings.
#pragma once
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

// Writes the key "radars" with an object for each link of each radar.
void write_radars(Line& line, const LiveFrame& frame, const RadarAnswer& radars);

}  // namespace wavetracer::live
