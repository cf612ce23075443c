// SPDX-License-Identifier: Apache-2.0
// The link budget: received power and signal-to-noise ratio of a link from its path gain.
// Noise is thermal, k T B at T = 290 K (IEEE's standard noise temperature), raised by the receiver's noise figure.
#pragma once
#include <cmath>
#include <limits>

#include "wavetracer/config.hpp"

namespace wavetracer {

struct LinkBudget {
  double received_dbm = 0, snr_db = 0;  // NaN where the configuration lacks a value that they need
};

// Noise power at the detector, dBm; NaN without radio.bandwidth_hz.
inline double noise_dbm(const RadioConfig& radio) {
  constexpr double boltzmann_j_k = 1.380649e-23, temperature_k = 290;
  if (!radio.bandwidth_hz) return std::numeric_limits<double>::quiet_NaN();
  return 10 * std::log10(boltzmann_j_k * temperature_k * *radio.bandwidth_hz / 1e-3) + radio.noise_figure_db;
}

// gain_db: that of the link, -inf where no power arrives.
inline LinkBudget link_budget(const RadioConfig& radio, double gain_db) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const double received_dbm = radio.transmit_power_dbm ? *radio.transmit_power_dbm + gain_db : nan;
  return {received_dbm, received_dbm - noise_dbm(radio)};
}

}  // namespace wavetracer
