// SPDX-License-Identifier: Apache-2.0
// The agreement of computed levels with measured ones.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace wavetracer::calibration {

// A measured and a computed level, dB; the computed one is -inf where there is no path.
struct LevelPair {
  double measured_db, computed_db;
};

// Measured minus computed: mean and standard deviation over the pairs with a path.
struct Statistics {
  size_t points = 0, with_a_path = 0;
  double offset_db = 0, sigma_db = 0;  // NaN of fewer than two points
  double spearman = 0;                 // correlation of ranks; NaN where one side has one rank only
};
Statistics statistics_of(std::span<const LevelPair> pairs);

// Ranks of the values, from 1 on; equal values share the mean of their ranks.
std::vector<double> ranks_of(std::span<const double> values);

// The statistics of a group of points: as the configuration is, with the fit to all points, and with fits to others.
struct Agreement {
  std::string name;
  Statistics before, after, held_out;
};

// Returns a sentence for points that agree less well where they were held out than as configured, by more than 5% of
// sigma: then the data do not support the fit. Empty for others.
std::string held_out_warning(const Agreement& all);

// Divides places into blocks of about the same number of points, by halves along the longer side. Returns the block of
// each, 0 to count - 1.
std::vector<unsigned> spatial_blocks(std::span<const double> x, std::span<const double> y, unsigned count);

}  // namespace wavetracer::calibration
