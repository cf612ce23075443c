// SPDX-License-Identifier: Apache-2.0
// The results of a run: sums over its frames, statistics of its links, and its files.
#pragma once
#include <filesystem>
#include <vector>
#include "jobs/link_statistics.hpp"
#include "output/totals.hpp"

namespace wavetracer {

// links: set if there are frames.
struct Results {
  Totals totals;
  LinkStatistics links;
  std::vector<std::filesystem::path> files;
};

}  // namespace wavetracer
