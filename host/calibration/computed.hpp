// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace wavetracer::calibration {

// The computed values of a measured point: gain in dB, -inf without a path, and rms delay spread in ns.
struct Computed {
  double gain_db = 0, delay_spread_ns = 0;
};

}  // namespace wavetracer::calibration
