// SPDX-License-Identifier: Apache-2.0
// Estimates what the rays of a run have missed, from those rays themselves: docs/method.md, "What was missed". A launch
// consists of four launches with a quarter of its rays each: the paths that few of them found show how many none has
// found.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace wavetracer {

struct Paths;

// Counts that add up over frames. Powers are sums of |a|^2.
struct MissedCounts {
  uint64_t frames = 0;   // with an estimate; 0: there is none
  uint64_t unknown = 0;  // frames whose rays do not show what they missed; nothing else counts these
  // [k]: paths that depend on rays and that k + 1 quarters found; [0] also counts paths that no quarter found alone,
  // because their parts come from different quarters.
  std::array<uint64_t, 4> paths{};
  std::array<double, 4> powers{};  // power of these paths
  // Sum of |a| over these paths: it is typical even if a few paths are much stronger than all others.
  double amplitude = 0;
  double power = 0;  // power of all paths
};
// low to high: the 95% confidence interval.
struct MissedRange {
  double estimate = 0, low = 0, high = 0;
};

struct Missed {
  MissedRange paths;        // their number
  MissedRange power_share;  // relative to the power that was found; 0 if that is 0
};

void add(MissedCounts& sum, const MissedCounts& more);
// Adds the counts of another part of the same frame; if one of them is unknown, all is.
void add_part(MissedCounts& sum, const MissedCounts& more);

// Counts rows first to end - 1 as one frame. Empty if it is not known which rays have found them.
MissedCounts missed_counts(const Paths& paths, size_t first, size_t end);

Missed estimate_missed(const MissedCounts& counts);

}  // namespace wavetracer
