// SPDX-License-Identifier: Apache-2.0
// Counts the paths of one frame that another frame has, where both were solved by us in the same world.
// Two paths are the same if link and delay (to 1e-12 s) agree, and also surfaces and instances, or else the power.
#pragma once
#include <cstddef>
#include <vector>

#include "wavetracer/paths.hpp"

namespace wavetracer::bench {

struct PathRecall {
  size_t reference = 0, mine = 0, found = 0;
  // Found shares of the reference, by number and by the sum of |a|^2; 1 if the reference is empty.
  double paths = 1, power = 1;

  size_t extra() const { return mine - found; }  // paths that the reference lacks
};

constexpr size_t no_row = static_cast<size_t>(-1);

// Returns for each row of the reference the row of `mine` that is the same path, or no_row. Each path is matched once.
// Both must be in the order that Paths promises, one frame each; frame numbers are not compared.
std::vector<size_t> matching_rows(const Paths& reference, const Paths& mine);

PathRecall path_recall(const Paths& reference, const Paths& mine);

}  // namespace wavetracer::bench
