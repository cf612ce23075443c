// What links.csv says that rays have missed on each link: it is not in paths.h5, which keeps no quarters of launches.
#pragma once
#include <string>
#include <vector>
#include "results/saved_run.hpp"

namespace wavetracer {

struct MissedShares {
  std::vector<double>
      values;           // missed_power_share of the links of all frames, as in /links of paths.h5; empty: unknown
  std::string warning;  // why they are unknown, where links.csv should say them
};

// Of the links.csv beside the run's paths.h5. Without one, or of a version that did not write the column: unknown.
MissedShares missed_shares(const SavedRun& run);

}  // namespace wavetracer
