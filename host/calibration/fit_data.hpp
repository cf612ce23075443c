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

// A datum that is no level: a spread of a point, or a bin of its profile of delays.
struct ShapeDatum {
  size_t point = 0;
  size_t kind = 0;  // place in spread_kinds; their number stands for a bin
  size_t bin = 0;
};

// The computed value of such a datum: the logarithm of a spread in its unit, or the level of a bin, dB; NaN where there
// is none.
double shape_db(const Computed& computed, const ShapeDatum& datum);

// Bins of measured profiles that are data, and the level of each; nothing without components.
std::vector<std::pair<size_t, double>> measured_bins(const MeasuredPoint& point, double bin_ns);

// The number of bins of the longest measured profile.
size_t most_bins(const std::vector<MeasuredFile>& files, double bin_ns);

// Kinds of data: levels, spreads and bins.
size_t kinds_of_data();

struct FitData {
  std::vector<Datum> data;         // levels of all points, then what else is fitted
  std::vector<ShapeDatum> shapes;  // the data after the levels
  std::vector<std::string> offset_names;
  std::vector<std::string> notes;  // measured values that are not fitted
};

// Returns the data of the points of a result, as the request wants them.
FitData fit_data(const Request& request, const Calibration& result);

}  // namespace wavetracer::calibration
