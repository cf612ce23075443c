// SPDX-License-Identifier: Apache-2.0
// Spreads of what arrives at a place, weighted by power, for measured components and for computed paths.
#pragma once
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace wavetracer::calibration {

// Sums of components of which each has a power, a delay and an azimuth of arrival.
class Spreads {
 public:
  // origin_s: a delay near those that follow, so that sums of squares keep their digits.
  explicit Spreads(double origin_s = 0) : origin_s_(origin_s) {}

  void add(double power, double delay_s, double azimuth_rad) {
    const double late_s = delay_s - origin_s_;
    power_ += power;
    delay_ += power * late_s;
    square_ += power * late_s * late_s;
    direction_ += std::polar(power, azimuth_rad);
  }
  double power() const { return power_; }
  // Standard deviation of the delays; NaN without power.
  double delay_ns() const {
    const double mean = delay_ / power_;
    return 1e9 * std::sqrt(std::max(square_ / power_ - mean * mean, 0.0));
  }
  // The circular angle spread of 3GPP TR 38.901, Annex A.1: sqrt(-2 ln |sum P exp(j phi) / sum P|); NaN without power.
  double azimuth_deg() const {
    const double length = std::min(std::abs(direction_) / power_, 1.0);
    return 180 / std::numbers::pi * std::sqrt(-2 * std::log(length));
  }

 private:
  double origin_s_, power_ = 0, delay_ = 0, square_ = 0;
  std::complex<double> direction_ = 0;
};

}  // namespace wavetracer::calibration
