// SPDX-License-Identifier: Apache-2.0
// Powers tell how much of a frame came late; numbers alone would count its weakest paths as much as its strongest.
#include "simulation/late_paths.hpp"

#include <algorithm>

#include "radio/path_power.hpp"

namespace wavetracer {
namespace {

double power_of_all(const Paths& paths) {
  double sum = 0;
  for (size_t row = 0; row < paths.size(); ++row) sum += power_of(paths, row);
  return sum;
}

}  // namespace

LateCounts late_counts(const Paths& known, const Paths& all) {
  LateCounts out{.discoveries = 1, .paths = all.size() - std::min(known.size(), all.size()), .all = power_of_all(all)};
  if (out.paths > 0) out.power = std::max(out.all - power_of_all(known), 0.0);
  out.largest_share = out.power_share();
  return out;
}

}  // namespace wavetracer
