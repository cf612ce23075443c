// SPDX-License-Identifier: Apache-2.0
// Detections of a map by a threshold that follows the mean of its surroundings (cell-averaging CFAR).
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include "wavetracer/radar.hpp"
#include "wavetracer/radar_config.hpp"

namespace wavetracer {

inline double dbm_of(double power_w) { return 10 * std::log10(power_w) + 30; }  // -inf for 0

// A cell of a map that is the largest of its neighbours and above its threshold, W.
struct DetectedCell {
  size_t shift, delay;
  double power_w, threshold_w;
};

// Finds those of a map in W, [Doppler shift][delay], by falling power. Thresholds are those of cells of white noise at
// one pair of antennas. Both axes are circles, as those of Fourier transforms.
std::vector<DetectedCell> detected_cells(const std::vector<double>& map_w, const RadarConfig& radar);

// Their ranges and speeds are those of a parabola through the peak and its neighbours in dB, and powers those of the
// cell. Angles are left empty.
RadarDetections detections_of(const std::vector<DetectedCell>& cells, const std::vector<double>& map_w,
                              const RadarAxes& axes, double carrier_hz);

}  // namespace wavetracer
