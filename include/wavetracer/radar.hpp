// SPDX-License-Identifier: Apache-2.0
// The radars of a configuration ([[radar]]) in a frame: range-Doppler cubes, maps and detections.
#pragma once
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "wavetracer/world_state.hpp"

namespace wavetracer {

// Cells of a map that are the largest of their neighbours and above the threshold, by falling power. Columns of equal
// length. Angles are those of the wave that arrives, in the axes of the receiving antenna; NaN where its array cannot
// tell them.
struct RadarDetections {
  std::vector<double> delay_s, doppler_hz;
  std::vector<double> range_m, speed_m_s;  // half the length of the path; the speed at which a target comes nearer
  std::vector<double> power_dbm, threshold_dbm;
  std::vector<double> azimuth_rad, elevation_rad;  // from ahead towards the left, and upwards
  size_t size() const { return delay_s.size(); }
};

// The columns of detections, in the order in which files and answers have them.
struct DetectionColumn {
  const char *name, *unit, *description;
  std::vector<double> RadarDetections::*values;
};
inline constexpr std::array detection_columns{
    DetectionColumn{"range_m", "m", "half the length of the path", &RadarDetections::range_m},
    DetectionColumn{"delay_s", "s", "delay of the path", &RadarDetections::delay_s},
    DetectionColumn{"speed_m_s", "m/s", "speed at which a target comes nearer", &RadarDetections::speed_m_s},
    DetectionColumn{"doppler_hz", "Hz", "Doppler shift", &RadarDetections::doppler_hz},
    DetectionColumn{"power_dbm", "dBm", "power of the cell", &RadarDetections::power_dbm},
    DetectionColumn{"threshold_dbm", "dBm", "threshold of the cell", &RadarDetections::threshold_dbm},
    DetectionColumn{"azimuth_rad", "rad", "from ahead of the receiving antenna towards its left; NaN: not known",
                    &RadarDetections::azimuth_rad},
    DetectionColumn{"elevation_rad", "rad", "upwards, in the axes of the receiving antenna; NaN: not known",
                    &RadarDetections::elevation_rad}};

// One link of a radar in a frame.
struct RadarRow {
  Link link;
  uint32_t left_out = 0;  // paths that are too long for the waveform
  // Roots of watts, [rx antenna][tx antenna][Doppler shift][delay]; antennas are port * elements + element.
  std::vector<std::complex<double>> cube;
  std::vector<double> power_dbm;     // the mean power over antennas, [Doppler shift][delay]; -inf: none
  std::vector<double> spectrum_dbm;  // the power of each Doppler shift, over all delays
  RadarDetections detections;
};

// The rows of a radar's links that are in a frame, sorted by link.
using RadarRows = std::vector<RadarRow>;

// Numbers that are the same in all rows of a radar.
struct RadarAxes {
  uint32_t rx_antennas = 1, tx_antennas = 1;
  std::vector<double> delay_s, range_m;       // range: half the length of a path
  std::vector<double> doppler_hz, speed_m_s;  // ascending; speed: that at which a target comes nearer
};

}  // namespace wavetracer
