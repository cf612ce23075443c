// SPDX-License-Identifier: Apache-2.0
// The agreement of computed spreads of delays and azimuths with measured ones.
#pragma once
#include <span>
#include <vector>
#include "calibration/calibration.hpp"
#include "study/text.hpp"

namespace wavetracer::calibration {

// A measured and a computed spread, in one unit; the computed one is NaN where there is no path.
struct SpreadPair {
  double measured, computed;
};

// Medians over the pairs with a computed spread; NaN if there are none.
struct SpreadStatistics {
  size_t points = 0;
  double measured = 0, computed = 0, ratio = 0;  // ratio: the median of computed / measured
};
SpreadStatistics spread_statistics(std::span<const SpreadPair> pairs);

// A row for each kind of spread that was measured, as configured and fitted; no row if none was.
study::NumberTable spread_table(const Calibration& result);

// Differences of measured and computed bins of profiles of delays, as configured, fitted and held out; no row if
// profiles were not asked for.
study::NumberTable profile_table(const Calibration& result);

}  // namespace wavetracer::calibration
