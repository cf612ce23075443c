// SPDX-License-Identifier: Apache-2.0
// The loop over units and their frames.
// catch_interrupts() must have been called, so that an interrupt ends the frame in progress at its next step.
#include "jobs/drive.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include "jobs/claims.hpp"
#include "jobs/earlier_run.hpp"
#include "jobs/interrupt.hpp"
#include "jobs/shards.hpp"
#include "jobs/solve_frame.hpp"
#include "jobs/team.hpp"
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
    frame = std::move(*next);
  }
  if (told.count() == 0) return {};
  told.finish(frame, repeats_agree(simulation.config()));
  run.summary.repeat_count = told.count();
  frame.missing = simulation.explain_missing(frame);
  progress.line("writing to " + run.config.output.directory);
  Results results;
  results.totals = totals_of({&frame, 1});
  results.files = write_outputs(run.config.output.directory, run, {&frame, 1});
  results.links = statistics_of(run);
  return results;
}

void say_damaged(const Shards& shards, Progress& progress) {
  for (const std::string& damage : shards.damaged())
    progress.line(fmt::format("damaged: {}; its frames are computed again", damage));
}

Units units_of(const DriveTask& task) {
  return {task.identity.first, task.identity.last, task.run.config.output.shard_frames, task.blocks};
}

namespace {

std::optional<TransmitterRange> block_of(const DriveTask& task, const Unit& unit) {
  if (unit.blocks <= 1) return std::nullopt;
  const uint64_t all = task.run.config.transmitters.size();
  return TransmitterRange{static_cast<uint32_t>(all * unit.block / unit.blocks),
                          static_cast<uint32_t>(all * (unit.block + 1) / unit.blocks)};
}

// Solves one frame in one of the repeats of its unit, counted from 0.
std::optional<FrameResult> solve_repeat(const DriveTask& task, const Unit& unit, uint64_t frame, uint32_t repeat,
                                        Progress& progress) {
  const RunIdentity& asked = task.identity;
  if (interrupted()) return std::nullopt;
  if (unit.blocks <= 1) {
    const std::string which = asked.repeat > 1 ? fmt::format(", repeat {} of {}", repeat + 1, asked.repeat) : "";
    const uint64_t before = (unit.first - asked.first) * uint64_t{asked.repeat} + repeat * unit.frames();
    progress.bar(fmt::format("frame {}{}", frame, which), before + frame - unit.first,
                 FrameRange{asked.first, asked.last}.count() * asked.repeat, "frames");
  }
  const bool alone = task.simulation.frame_count() == 1 && asked.repeat == 1 && unit.blocks <= 1;
  return solve_frame(task.simulation, static_cast<uint32_t>(frame), alone, progress, block_of(task, unit));
}

}  // namespace

bool solve_unit(const DriveTask& task, const Unit& unit, UnitWriter& writer, Progress& progress) {
  const RunIdentity& asked = task.identity;
  std::vector<FrameRepeats> told(unit.frames());
  for (uint32_t repeat = 0; repeat + 1 < asked.repeat; ++repeat) {
    task.simulation.forget();
    for (uint64_t frame = unit.first; frame <= unit.last; ++frame) {
      const std::optional<FrameResult> result = solve_repeat(task, unit, frame, repeat, progress);
      if (!result) return false;  // interrupted
      told[frame - unit.first].add(*result);
    }
  }
  // The last repeat is written.
  task.simulation.forget();
  writer.begin(unit);
  bool explained = false;
  for (uint64_t frame = unit.first; frame <= unit.last; ++frame) {
    std::optional<FrameResult> result = solve_repeat(task, unit, frame, asked.repeat - 1, progress);
    if (!result) return false;  // interrupted
    told[frame - unit.first].add(*result);
    told[frame - unit.first].finish(*result, repeats_agree(task.simulation.config()));
    const bool stop = frame == unit.last || interrupted();
    // Why a drive has no path at all is asked once per unit; if other processes have found one, the answer is not used.
    const bool ask = unit.blocks > 1 || asked.first == asked.last || result->paths.size() == 0;
    if (!explained && !result->world.links.empty() && ask) {
      result->missing = task.simulation.explain_missing(*result);
      explained = true;
    }
    writer.add(std::move(*result));
    if (stop) return frame == unit.last;
  }
  return true;
}

bool compute_unit(const DriveTask& task, const Unit& unit, UnitWriter& writer, Progress& progress) {
  const bool whole = solve_unit(task, unit, writer, progress);
  if (whole)
    writer.end();
  else
    writer.drop();
  return whole;
}

Results drive(const DriveTask& task, Progress& progress) {
  const std::string& directory = task.run.config.output.directory;
  Shards shards(directory, task.identity, task.run.summary.inputs, task.run.config.text);
  remove_claims(shards.folder());  // left by processes that shared the folder and were killed
  remove_dead_temporaries(shards.folder());
  if (task.resume) {
    shards.resume();
    say_what_is_there(shards, task.identity, directory, progress);
  }
  if (shards.complete()) return {shards.totals(), statistics_of(task.run), shards.outputs()};
  Results results;
  const Units units = units_of(task);
  MergeAhead ahead(task.run.config, units, directory);
  UnitWriter writer(task.run, shards, progress);
  writer.tell(ahead);
  for (uint64_t index = 0; index < units.count() && !interrupted(); ++index) {
    const Unit unit = units.at(index);
    if (shards.finished(unit)) continue;
    if (!solve_unit(task, unit, writer, progress)) break;
    writer.end();
  }
  writer.finish();
  std::unique_ptr<OpenUnit> unfinished = writer.unfinished();
  results.totals = shards.totals();
  if (unfinished) add(results.totals, unfinished->totals());
  if (results.totals.frames > 0) {
    progress.line("writing to " + directory);
    results.files = shards.merge(task.run, std::move(unfinished), &ahead, &results.links);
    shards.remove_merged();
  }
  return results;
}

}  // namespace wavetracer
