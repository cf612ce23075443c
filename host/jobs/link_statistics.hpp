// SPDX-License-Identifier: Apache-2.0
// Statistics of a run's links for its closing report, read from its links.csv, whichever processes wrote the parts.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>
#include "wavetracer/config.hpp"

namespace wavetracer {

// The values below which a tenth, half and nine tenths lie.
struct Quantiles {
  double low = 0, median = 0, high = 0;
};

// Returns the quantiles of finite values; zeros if there are none. They are interpolated linearly, as numpy.quantile()
// does.
Quantiles quantiles(std::vector<double> values);

// A pair of ends, with both directions as one.
struct PairSummary {
  std::string name;                 // "rsu -> car", or "a <-> b" if both directions were computed
  double mean_gain_db = 0;          // gain of the mean power over all frames in which it has a path
  double mean_delay_spread_s = 0;   // over these frames
  uint64_t rows = 0, los_rows = 0;  // rows with a path (frames and directions); those of them with line of sight
};

struct GridSummary {
  std::string name;
  uint64_t cells = 0, covered = 0;  // covered: cells with a path from any transmitter in any frame
  Quantiles gain_db;                // gain of the best transmitter, over the covered cells
};

struct LinkStatistics {
  uint64_t asked = 0, with_path = 0, los = 0;  // numbers of rows, including grids
  Quantiles gain_db, delay_spread_s;           // over rows with power
  std::vector<PairSummary> pairs;              // pairs with a path, the strongest first, without grids
  std::vector<GridSummary> grids;              // in the order of the configuration
};

// config: with all receivers of the run. Throws RuntimeError if the file was not written by a run.
LinkStatistics link_statistics(const std::filesystem::path& links_csv, const Config& config);

}  // namespace wavetracer
