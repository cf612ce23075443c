// SPDX-License-Identifier: Apache-2.0
#include "radio/most_power.hpp"

#include <algorithm>
#include <cmath>

namespace wavetracer {
namespace {

constexpr double rounding = 1e-9;

// The largest squared length of the samples of a grid.
double most_of_grid(const device::wt_antenna& antenna, const std::vector<double>& samples) {
  double most = 0;
  for (size_t i = 0; i < size_t{antenna.rows} * antenna.columns; ++i) {
    double power = 0;
    for (size_t k = 0; k < 4; ++k) {
      const double part = samples[4 * (antenna.first_sample + i) + k];
      power += part * part;
    }
    most = std::max(most, power);
  }
  return most;
}

// wt_pattern (wavetracer/device/antenna.h): its largest squared length.
double most_of_pattern(const device::wt_antenna& antenna, const std::vector<double>& samples) {
  switch (antenna.pattern) {
    case WT_PATTERN_ISOTROPIC:
      return 1;
    case WT_PATTERN_SHORT_DIPOLE:
      return 1.5;
    case WT_PATTERN_HALF_WAVE_DIPOLE:
      return 1.6409223769845852;
    case WT_PATTERN_TR38901:
      return std::pow(10.0, 0.8);
    default:
      return most_of_grid(antenna, samples);
  }
}

}  // namespace

std::vector<double> most_powers(const FieldTables& tables) {
  std::vector<double> out;
  for (const device::wt_antenna& antenna : tables.antennas)
    out.push_back(antenna.ports * most_of_pattern(antenna, tables.samples) * (1 + rounding));
  return out;
}

}  // namespace wavetracer
