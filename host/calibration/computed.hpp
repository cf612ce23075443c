// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

namespace wavetracer::calibration {

// The computed values of a measured point: gain in dB, -inf without a path, rms delay spread in ns, and circular spread
// of the azimuths of arrival in degrees (calibration/spreads.hpp). Spreads are NaN without a path. profile:
// delay_profile(), if it is wanted; empty without a path.
struct Computed {
  double gain_db = 0, delay_spread_ns = 0, azimuth_spread_deg = 0;
  std::vector<double> profile = {};
};

}  // namespace wavetracer::calibration
