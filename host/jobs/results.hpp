// What a run comes to: sums over its frames, statistics of its links, the files that hold it.
#pragma once
#include <filesystem>
#include <vector>
#include "jobs/link_statistics.hpp"
#include "output/totals.hpp"

namespace wavetracer {

// links: where there are frames.
struct Results {
  Totals totals;
  LinkStatistics links;
  std::vector<std::filesystem::path> files;
};

}  // namespace wavetracer
