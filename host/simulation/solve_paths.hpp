// SPDX-License-Identifier: Apache-2.0
// The half of a frame that makes exact paths of sequences: the passes from sequences to visible, for all kinds of
// paths.
#pragma once
#include "simulation/exact_paths.hpp"
#include "simulation/frame_account.hpp"
#include "simulation/frame_watch.hpp"

namespace wavetracer {

// Finds the exact paths of the sequences that rays have found, in exact.visible.list(). searched: rays may have added
// sequences since the last call; then their exchanges are added. Returns the counts that no counter has.
Uncounted solve_paths(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set, bool searched,
                      const FrameWatch& watch, FrameAccount& account);

}  // namespace wavetracer
