// SPDX-License-Identifier: Apache-2.0
// The edges of a frame as the passes of paths over tiles and targets take them.
#pragma once
#include "passes/wedge_candidates.hpp"
#include "passes/wedge_lists.hpp"

namespace wavetracer {

// The edges of a frame, and the prefixes of all ends that see them, sorted by their edges; candidates: a list that
// nothing else uses meanwhile.
struct SeenEdges {
  const WedgeList& wedges;
  const WedgePrefixList& prefixes;
  WedgeCandidates& candidates;
};

}  // namespace wavetracer
