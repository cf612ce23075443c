// SPDX-License-Identifier: Apache-2.0
// Repeats of a frame must agree: a device with different answers cannot be trusted. But with a quantised cache, chance
// decides which of two similar rays answers for both.
// The first repeat is part of the median, as every frame of a drive is.
#include "jobs/solve_frame.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "jobs/interrupt.hpp"
#include "output/median.hpp"

namespace wavetracer {

std::string words_of(const FrameProgress& at) {
  if (at.stage != "rays") return "solving its paths";
  return fmt::format("{}% of its rays", 100 * at.done / std::max<uint64_t>(at.total, 1));
}

std::optional<FrameResult> solve_frame(Simulation& simulation, uint32_t frame, bool alone, Progress& progress,
                                       std::optional<TransmitterRange> block) {
  simulation.observe([alone, &progress](const FrameProgress& at) {
    const bool rays = at.stage == "rays";
    if (alone && at.parts > 1) {  // each part traces and solves: one clock can only count the batches
      progress.bar(fmt::format("batch {}", at.part + 1), at.part, at.parts, "batches");
      progress.within(rays ? "tracing" : "solving paths");
    } else if (alone)
      progress.bar(rays ? "tracing" : "solving paths", at.done, at.total, rays ? "rays" : "steps");
    else
      progress.within(words_of(at));
    return !interrupted();
  });
  std::optional<FrameResult> out;
  try {
    out = block ? simulation.run_block(frame, *block) : simulation.run_frame(frame);
  } catch (const FrameStopped&) {
    out.reset();
  }
  simulation.observe({});
  return out;
}

void FrameRepeats::add(const FrameResult& frame) {
  for (const auto& [stage, seconds] : frame.seconds) seconds_[stage].push_back(seconds);
  paths_.push_back(frame.counts.paths);
  warnings_.insert(frame.warnings.begin(), frame.warnings.end());
}

void FrameRepeats::finish(FrameResult& last, bool must_agree) const {
  for (const auto& [stage, values] : seconds_) last.seconds[stage] = median(values);
  std::set<std::string> warnings = warnings_;
  for (size_t i = 1; must_agree && i < paths_.size(); ++i)
    if (paths_[i] != paths_[i - 1])
      warnings.insert(fmt::format(
          "repeat {} found {} paths, the one before {}: this device gives wrong results, so do not trust it", i,
          paths_[i], paths_[i - 1]));
  last.warnings.assign(warnings.begin(), warnings.end());
}

bool repeats_agree(const Config& config) { return !config.cache.on() || config.cache.exact(); }

}  // namespace wavetracer
