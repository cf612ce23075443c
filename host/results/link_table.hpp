// SPDX-License-Identifier: Apache-2.0
// Reads links.csv of a run. It has more than paths.h5: all paths, including those that output limits have left out of
// the file, and the power that rays have missed.
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>
#include "results/saved_run.hpp"

namespace wavetracer {

// Each column has a value per row of /links of paths.h5; a column is empty if it is unknown.
struct LinkTable {
  std::vector<double> paths, path_gain_db, narrowband_gain_db, rms_delay_spread_s, los, missed_power_share,
      left_out_power_share, tx_beam, rx_beam, beam_gain_db, k_factor_db;
  std::string warning;  // why all are unknown although links.csv exists
};

// Reads the links.csv beside the run's paths.h5. Without that file all columns are unknown, and there is no warning.
LinkTable link_table(const SavedRun& run);

}  // namespace wavetracer
