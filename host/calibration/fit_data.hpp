// SPDX-License-Identifier: Apache-2.0
// The numbers that a fit is made to.
#pragma once
#include <cstddef>
#include <string>
#include <utility>
#include <vector>
#include "calibration/calibration.hpp"
#include "calibration/fit.hpp"

namespace wavetracer::calibration {

// The logarithm of a spread in its unit, dB.
double spread_db(double spread);

struct FitData {
  std::vector<Datum> data;                         // levels of all points, then the spreads that are fitted
  std::vector<std::pair<size_t, size_t>> spreads;  // points whose spreads are data, and the kinds of these spreads
  std::vector<std::string> offset_names;
  std::vector<std::string> notes;  // measured values that are not fitted
};

// Returns the data of the points of a result, as the request wants them.
FitData fit_data(const Request& request, const Calibration& result);

}  // namespace wavetracer::calibration
