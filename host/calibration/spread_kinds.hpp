// SPDX-License-Identifier: Apache-2.0
// The kinds of spreads that are compared and fitted.
#pragma once
#include <array>
#include <optional>
#include "calibration/computed.hpp"
#include "calibration/measured.hpp"

namespace wavetracer::calibration {

struct SpreadKind {
  const char *word, *name;  // word: of FittedSpreads; name: with its unit
  std::optional<double> MeasuredPoint::*measured;
  double Computed::*computed;
};
inline constexpr std::array spread_kinds{
    SpreadKind{"delay", "delay, ns", &MeasuredPoint::delay_spread_ns, &Computed::delay_spread_ns},
    SpreadKind{"azimuth", "azimuth, degrees", &MeasuredPoint::azimuth_spread_deg, &Computed::azimuth_spread_deg}};

}  // namespace wavetracer::calibration
