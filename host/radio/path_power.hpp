// SPDX-License-Identifier: Apache-2.0
// The power of a path, its phase, and the end of the rows of its link, whose fields are added.
#pragma once
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "wavetracer/paths.hpp"

namespace wavetracer {

// Received power of path `row` relative to the transmitted power: |a|^2, summed over pairs of ports.
inline double power_of(const Paths& paths, size_t row) {
  double power = 0;
  for (const auto& a : paths.a[row]) power += std::norm(a);
  return power;
}

// exp(-j 2 pi f tau). Whole turns of the phase are removed before the sine is taken.
inline std::complex<double> carrier_phase(double frequency_hz, double delay_s) {
  const double turns = frequency_hz * delay_s;
  return std::polar(1.0, -2 * std::numbers::pi * (turns - std::floor(turns)));
}

// The end of the rows of one frame and link; `first` is the first of these rows. Rows are sorted by frame and link.
inline size_t end_of_link(const Paths& paths, size_t first) {
  size_t end = first + 1;
  while (end < paths.size() && paths.frame[end] == paths.frame[first] && paths.tx[end] == paths.tx[first] &&
         paths.rx[end] == paths.rx[first])
    ++end;
  return end;
}

}  // namespace wavetracer
