// SPDX-License-Identifier: Apache-2.0
// The half of a frame that makes exact paths of sequences: the passes from sequences to visible, for all kinds of
// paths.
#pragma once
#include <functional>
#include <optional>

#include "simulation/exact_paths.hpp"
#include "simulation/frame_account.hpp"
#include "simulation/frame_watch.hpp"

namespace wavetracer {

// The search for sequences before exact paths are made: none since the last call, by few rays in a frame that only
// compiles, or by all rays.
enum class Search { none, few, all };

// Finds the exact paths of the sequences that rays have found, in exact.visible.list(). After a search it adds the
// exchanges of sequences, and searches from edges. floor_links: is called when the list has all paths without edges,
// and returns the floors of links, if they have any. Returns the counts that no counter has.
Uncounted solve_paths(ExactPaths& exact, const DeviceScene& scene, const RadioEnds& ends, Sequences& set, Search search,
                      const FrameWatch& watch, FrameAccount& account,
                      const std::function<std::optional<LinkLimits>()>& floor_links = {});

}  // namespace wavetracer
