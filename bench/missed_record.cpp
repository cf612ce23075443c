// SPDX-License-Identifier: Apache-2.0
// Counts over cases.
// The factor of three is the calibration that docs/method.md promises for the power.
#include "missed_record.hpp"

#include <fmt/format.h>

namespace wavetracer::bench {
namespace {

constexpr double near_factor = 3;

bool holds(const MissedRange& range, double truth) { return range.low <= truth && truth <= range.high; }

}  // namespace

void MissedRecord::add(bool kept, uint64_t segments, double seconds, const LostInTruth& truth,
                       const std::optional<Missed>& said) {
  ++cases_;
  kept_ += kept;
  segments_ += segments;
  seconds_ += seconds;
  path_shares_ += truth.path_share;
  if (!said) return;
  ++told_;
  paths_held_ += holds(said->paths, truth.paths);
  power_held_ += holds(said->power_share, truth.power_share);
  if (truth.paths == 0) return;
  ++losing_;
  const double estimate = said->power_share.estimate;
  power_near_ += estimate <= near_factor * truth.power_share && truth.power_share <= near_factor * estimate;
}

std::string words_of(const Missed& missed) {
  return fmt::format("{:.3g} ({:.3g} to {:.3g}), {:.1e} ({:.1e} to {:.1e})", missed.paths.estimate, missed.paths.low,
                     missed.paths.high, missed.power_share.estimate, missed.power_share.low, missed.power_share.high);
}

std::string words_of(const MissedRecord& record, double recall) {
  const std::string unknown =
      record.unknown() > 0 ? fmt::format("; missed is unknown in {} cases", record.unknown()) : "";
  return fmt::format(
      "{} of {} cases at recall {} or more; paths in their interval {:.0f}%, power {:.0f}%; "
      "where something is lost ({} cases) its power is within a factor of three {:.0f}%{}; {:.3g} s, "
      "{:.3g} segments",
      record.kept(), record.cases(), recall, 100 * record.paths_held(), 100 * record.power_held(), record.losing(),
      100 * record.power_near(), unknown, record.seconds(), static_cast<double>(record.segments()));
}

}  // namespace wavetracer::bench
