// SPDX-License-Identifier: Apache-2.0
#include "app/missed_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/digits.hpp"
#include "config/edge_rays.hpp"
#include "radio/missed_unknown.hpp"
#include "wavetracer/interaction_kinds.hpp"

namespace wavetracer::app {
namespace {

// Says in how many frames it is not known what rays have missed, and why; empty if there are none.
std::string missed_unknown_line(const Run& run, const Totals& totals) {
  const MissedCounts& of = totals.missed;
  if (of.unknown == 0) return "";
  const std::string frames =
      of.unknown < totals.frames ? fmt::format(" in {} of {} frames", grouped(of.unknown), grouped(totals.frames)) : "";
  return fmt::format("{:<11}unknown{}: {}\n", of.frames > 0 ? "" : "missed", frames, missed_unknown_reason(run.config));
}

uint64_t diffracted_paths(const Totals& totals) {
  const auto at = std::ranges::find(path_kinds, "diffracted", &PathKind::word);
  return totals.kinds[static_cast<size_t>(at - path_kinds.begin())];
}

// The keys that make a run find more. Where most paths are diffracted, so are most of those that were missed: they need
// the rays of both ends, and those of receivers are fewer.
std::string more_rays(const Run& run, const Totals& totals) {
  const TraceConfig& trace = run.config.trace;
  const std::string rays = trace.rays ? "number of trace.rays" : "trace.recall";
  if (run.summary.edge_rays > 0)
    return trace.rays ? rays + " or of trace.edge_rays" : rays + " or number of trace.edge_rays";
  const bool receivers_launch = trace.diffraction && config::listener_count(run.config) > 0;
  if (!receivers_launch || 2 * diffracted_paths(totals) <= totals.counts.paths) return rays;
  return trace.rays ? "number of trace.diffraction_rays (at most trace.rays)"
                    : "trace.recall and number of trace.diffraction_rays";
}

}  // namespace

std::string missed_line(const Run& run, const Totals& totals) {
  if (totals.missed.frames == 0) return missed_unknown_line(run, totals);
  const Missed missed = estimate_missed(totals.missed);
  const bool none = missed.paths.estimate < 0.5;
  const std::string about =
      none ? "probably none" : "about " + grouped(static_cast<uint64_t>(std::nearbyint(missed.paths.estimate)));
  return fmt::format("missed     {} of {} paths ({} to {}), {:.1g} of the power ({:.1g} to {:.1g}){}\n", about,
                     grouped(totals.counts.paths), grouped(static_cast<uint64_t>(std::nearbyint(missed.paths.low))),
                     grouped(static_cast<uint64_t>(std::ceil(missed.paths.high))), missed.power_share.estimate,
                     missed.power_share.low, missed.power_share.high,
                     none ? "" : fmt::format(": a higher {} finds more of them", more_rays(run, totals))) +
         missed_unknown_line(run, totals);
}

}  // namespace wavetracer::app
