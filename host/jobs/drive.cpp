// SPDX-License-Identifier: Apache-2.0
// Runs of one process: a world where nothing moves, a drive, and a part of a run whose other parts run elsewhere.
#include "jobs/drive.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include "jobs/claims.hpp"
#include "jobs/compute_unit.hpp"
#include "jobs/earlier_run.hpp"
#include "jobs/interrupt.hpp"
#include "jobs/solve_frame.hpp"
#include "jobs/write_outputs.hpp"
#include "output/path_limits.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr uint32_t most_blocks = 32;

void say_what_is_there(const Shards& shards, const RunIdentity& asked, const std::string& directory,
                       Progress& progress) {
  say_damaged(shards, progress);
  const uint64_t done = shards.totals().frames, all = FrameRange{asked.first, asked.last}.count();
  if (done == 0)
    progress.line(
        fmt::format("--resume: {} contains no finished shard, so the run starts from the beginning", directory));
  else if (shards.complete())
    progress.line("--resume: the run is complete, all frames are in the outputs; nothing is left to do");
  else if (done == all)
    progress.line("--resume: all frames are computed already; the outputs are written again");
  else
    progress.line(fmt::format("--resume: {} of {} frames are computed already", done, all));
}

LinkStatistics statistics_of(const Run& run) {
  return link_statistics(std::filesystem::path(run.config.output.directory) / "links.csv", run.config);
}

}  // namespace

uint32_t block_count(const Config& config) {
  const auto transmitters = static_cast<uint32_t>(config.transmitters.size());
  if (const std::string why = block_obstacle(config); !why.empty() && transmitters > 1)
    throw ConfigError(
        fmt::format("this run is one frame, which several processes cannot share: {}; run one process alone", why));
  return std::clamp(transmitters, 1u, most_blocks);
}

Results run_still(Simulation& simulation, Run& run, Progress& progress) {
  if (interrupted()) return {};
  const uint32_t repeats = run.summary.repeat_count;
  FrameResult frame;
  FrameRepeats told;
  while (told.count() < repeats && !interrupted()) {
    if (repeats > 1) {
      simulation.forget();
      progress.bar("repeating", told.count(), repeats, "repeats");
    }
    std::optional<FrameResult> next = solve_frame(simulation, 0, repeats == 1, progress);
    if (!next) break;
    told.add(*next);
    std::swap(frame, *next);
    simulation.give_back(*next);
  }
  if (told.count() == 0) return {};
  told.finish(frame, repeats_agree(simulation.config()));
  run.summary.repeat_count = told.count();
  frame.missing = simulation.explain_missing(frame);
  progress.line("writing to " + run.config.output.directory);
  Results results;
  results.totals = totals_of({&frame, 1});
  if (const OutputConfig& output = run.config.output; limits_paths(output))
    results.totals.left_out = left_out(frame, written_rows(frame.paths, output));
  results.files = write_frame(run.config.output.directory, run, std::move(frame));
  results.links = statistics_of(run);
  return results;
}

Results drive(const DriveTask& task, Progress& progress) {
  const std::string& directory = task.run.config.output.directory;
  Shards shards = shards_of(task);
  remove_claims(shards.folder());  // left by processes that shared the folder and were killed
  remove_dead_temporaries(shards.folder());
  if (task.resume) {
    shards.resume();
    say_what_is_there(shards, task.identity, directory, progress);
  }
  if (shards.complete()) return {shards.totals(), statistics_of(task.run), shards.outputs()};
  Results results;
  const Units units = units_of(task);
  UnitWriter writer(task.run, shards, progress);
  writer.follow(std::make_unique<MergeAhead>(task.run.config, units, directory));
  for_each_unit(
      units, {.count = units.count()},
      {.finished = [&](const Unit& unit) { return shards.finished(unit); },
       .choose = [](const Unit&) { return interrupted() ? UnitChoice::stop : UnitChoice::compute; },
       .compute = [&](const Unit& unit) { return compute_unit(task, unit, Interrupted::keep, writer, progress); }});
  std::unique_ptr<OpenUnit> unfinished = writer.take_unfinished();
  results.totals = shards.totals();
  if (unfinished) add(results.totals, unfinished->totals());
  if (results.totals.frames > 0) {
    progress.line("writing to " + directory);
    const std::unique_ptr<MergeAhead> ahead = writer.take_ahead();
    results.files = shards.merge(task.run, std::move(unfinished), ahead.get(), &results.links);
    shards.remove_merged();
  }
  return results;
}

Shared drive_part(const DriveTask& task, const ShardChoice& part, Progress& progress) {
  Shards shards = shards_of(task);
  remove_claims(shards.folder());  // left by processes that shared the folder in another way, and were killed
  remove_dead_temporaries(shards.folder());
  if (task.resume) shards.find_complete();
  shards.share(fmt::format("{}_of_{}", part.index, part.count), task.resume);
  say_damaged(shards, progress);
  UnitWriter writer(task.run, shards, progress);
  const Units units = units_of(task);
  Shared shared;
  shared.units = units.count() > part.index ? (units.count() - part.index - 1) / part.count + 1 : 0;
  if (shared.units == 0) shards.note_empty(task.run);
  const UnitCounts counts = for_each_unit(
      units, {.first = part.index, .step = part.count, .count = shared.units},
      {.finished = [&](const Unit& unit) { return task.resume && shards.finished(unit); },
       .choose = [](const Unit&) { return interrupted() ? UnitChoice::leave : UnitChoice::compute; },
       .compute = [&](const Unit& unit) { return compute_unit(task, unit, Interrupted::drop, writer, progress); }});
  shared.missing = counts.missing();
  writer.finish();
  return shared;
}

}  // namespace wavetracer
