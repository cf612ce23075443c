// SPDX-License-Identifier: Apache-2.0
// Paths that frames without rays may lack (trace.discover_every_s), measured when rays are launched again: the paths
// that the earlier sequences did not give.
#pragma once
#include <algorithm>
#include <cstdint>

namespace wavetracer {

// Counts that add up over frames. Powers are sums of |a|^2.
struct LateCounts {
  uint64_t discoveries = 0;   // number of frames that were measured; 0: nothing is known
  uint64_t paths = 0;         // paths that the earlier sequences did not give
  double power = 0, all = 0;  // power of these paths, and of all paths of these frames
  double largest_share = 0;   // largest share of power in all, over frames

  void add(const LateCounts& more) {
    discoveries += more.discoveries;
    paths += more.paths;
    power += more.power;
    all += more.all;
    largest_share = std::max(largest_share, more.largest_share);
  }
  double power_share() const { return all > 0 ? power / all : 0; }
};

}  // namespace wavetracer
