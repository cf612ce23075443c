// What the rays of a run may have missed, estimated from those rays themselves: docs/method.md, "What was missed".
// A launch is four launches of a quarter of its rays: paths that few of them found tell of those that none has found.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace wavetracer {

struct Paths;

// Counts that add up over frames. Powers are sums of |a|^2.
struct MissedCounts {
  uint64_t frames = 0;  // 0: nothing is known
  // [k]: those that rays had to find and k + 1 quarters found; [0] also those that none found alone, whose parts are
  // of different quarters.
  std::array<uint64_t, 4> paths{};
  std::array<double, 4> powers{};  // of these
  double amplitude = 0;  // of these, sum of |a|: what is typical, where a few are much stronger than all others
  double power = 0;      // of all paths
};
// low to high: where the truth is in 95 cases of 100.
struct MissedRange {
  double estimate = 0, low = 0, high = 0;
};

struct Missed {
  MissedRange paths;        // their number
  MissedRange power_share;  // against the power that was found; 0 where that is 0
};

void add(MissedCounts& sum, const MissedCounts& more);
// Of another part of the same frames.
void add_part(MissedCounts& sum, const MissedCounts& more);

// Rows first to end - 1, as one frame. Nothing where it is not known who found them.
MissedCounts missed_counts(const Paths& paths, size_t first, size_t end);

Missed estimate_missed(const MissedCounts& counts);

}  // namespace wavetracer
