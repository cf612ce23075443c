// Repeats of a frame must agree; a device that answers differently is not to be trusted. But with a quantised cache
// chance decides which of two like rays answers for both.
// The first repeat is part of the median, as every frame of a drive is.
#include "jobs/solve_frame.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "jobs/interrupt.hpp"
#include "output/median.hpp"

namespace wavetracer {

namespace {

// One repeat; nothing where it was interrupted.
std::optional<FrameResult> solve_once(Simulation& simulation, uint32_t frame,
                                      const std::optional<TransmitterRange>& block) {
  try {
    return block ? simulation.run_block(frame, *block) : simulation.run_frame(frame);
  } catch (const FrameStopped&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<SolvedFrame> solve_frame(Simulation& simulation, uint32_t frame, uint32_t repeats, Progress& progress,
                                       std::optional<TransmitterRange> block) {
  const bool alone = simulation.frame_count() == 1 && repeats == 1 && !block;
  simulation.observe([alone, &progress](const FrameProgress& at) {
    const bool rays = at.stage == "rays";
    if (alone && at.parts > 1) {  // each traces and solves: the batches are what one clock can count
      progress.bar(fmt::format("batch {}", at.part + 1), at.part, at.parts, "batches");
      progress.within(rays ? "tracing" : "solving paths");
    } else if (alone)
      progress.bar(rays ? "tracing" : "solving paths", at.done, at.total, rays ? "rays" : "steps");
    else
      progress.within(rays ? fmt::format("{}% of its rays", 100 * at.done / std::max<uint64_t>(at.total, 1))
                           : "solving its paths");
    return !interrupted();
  });
  SolvedFrame solved;
  FrameResult& result = solved.result;
  std::map<std::string, std::vector<double>> samples;
  const CacheConfig& cache = simulation.config().cache;
  const bool must_agree = cache.kind == "none" || cache.key == "exact";
  do {
    if (repeats > 1) {
      simulation.forget();
      if (simulation.frame_count() == 1) progress.bar("repeating", solved.repeated, repeats, "repeats");
    }
    std::optional<FrameResult> next = solve_once(simulation, frame, block);
    if (!next) break;
    if (must_agree && solved.repeated > 0 && next->counts.paths != result.counts.paths)
      next->warnings.push_back(fmt::format(
          "repeat {} found {} paths, the one before {}: this device gives wrong results, so do not trust it",
          solved.repeated, next->counts.paths, result.counts.paths));
    for (const auto& [stage, seconds] : next->seconds) samples[stage].push_back(seconds);
    next->warnings.insert(next->warnings.begin(), result.warnings.begin(), result.warnings.end());
    result = std::move(*next);
  } while (++solved.repeated < repeats && !interrupted());
  simulation.observe({});
  if (solved.repeated == 0) return std::nullopt;
  for (const auto& [stage, values] : samples) result.seconds[stage] = median(values);
  std::sort(result.warnings.begin(), result.warnings.end());
  result.warnings.erase(std::unique(result.warnings.begin(), result.warnings.end()), result.warnings.end());
  return solved;
}

}  // namespace wavetracer
