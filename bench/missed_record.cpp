// SPDX-License-Identifier: Apache-2.0
// Counts over cases.
// The factor of three is the calibration that docs/method.md promises for the power.
#include "missed_record.hpp"

namespace wavetracer::bench {
namespace {

constexpr double near_factor = 3;

bool holds(const MissedRange& range, double truth) { return range.low <= truth && truth <= range.high; }

}  // namespace

void MissedRecord::add(bool kept, uint64_t segments, double seconds, const LostInTruth& truth, const Missed& said) {
  ++cases_;
  kept_ += kept;
  segments_ += segments;
  seconds_ += seconds;
  path_shares_ += truth.path_share;
  paths_held_ += holds(said.paths, truth.paths);
  power_held_ += holds(said.power_share, truth.power_share);
  if (truth.paths == 0) return;
  ++losing_;
  const double estimate = said.power_share.estimate;
  power_near_ += estimate <= near_factor * truth.power_share && truth.power_share <= near_factor * estimate;
}

}  // namespace wavetracer::bench
