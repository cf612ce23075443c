// What the links of a run amount to, for its closing report: read from its links.csv, whoever wrote the parts.
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

// Of values that are all finite; zeros where there is none. Linear between neighbours, as numpy.quantile() has it.
Quantiles quantiles(std::vector<double> values);

// A pair of ends, both ways as one.
struct PairSummary {
  std::string name;                 // "rsu -> car", or "a <-> b" where both ways are asked for
  double mean_gain_db = 0;          // of the mean power over all frames in which it has a path
  double mean_delay_spread_s = 0;   // over these frames
  uint64_t rows = 0, los_rows = 0;  // frames and ways with a path; of these in line of sight
};

struct GridSummary {
  std::string name;
  uint64_t cells = 0, covered = 0;  // covered: with a path of any transmitter in any frame
  Quantiles gain_db;                // of the best transmitter, over the cells that are covered
};

struct LinkStatistics {
  uint64_t asked = 0, with_path = 0, los = 0;  // rows; grids included
  Quantiles gain_db, delay_spread_s;           // over rows with power
  std::vector<PairSummary> pairs;              // with a path, the strongest first; grids left out
  std::vector<GridSummary> grids;              // in the order of the configuration
};

// config: with all receivers of the run. Throws RuntimeError where the file is not one that a run writes.
LinkStatistics link_statistics(const std::filesystem::path& links_csv, const Config& config);

}  // namespace wavetracer
