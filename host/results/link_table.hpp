// What links.csv says of the links of a run. It knows more than paths.h5: all paths, also those that output limits have
// left out of the file, and what rays have missed.
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>
#include "results/saved_run.hpp"

namespace wavetracer {

// A value per row of /links of paths.h5 in each column; a column is empty where it is unknown.
struct LinkTable {
  std::vector<double> paths, path_gain_db, narrowband_gain_db, rms_delay_spread_s, los, missed_power_share;
  std::string warning;  // why all are unknown, where links.csv should say them
};

// Of the links.csv beside the run's paths.h5. Without one all columns are unknown, and without warning.
LinkTable link_table(const SavedRun& run);

}  // namespace wavetracer
