// SPDX-License-Identifier: Apache-2.0
// The loop over the frames of a unit.
// catch_interrupts() must have been called, so that an interrupt ends the frame in progress at its next step.
#include "jobs/compute_unit.hpp"
#include <fmt/format.h>
#include <optional>
#include <utility>
#include "jobs/interrupt.hpp"
#include "jobs/solve_frame.hpp"

namespace wavetracer {
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

// Returns false if an interrupt came first, which leaves the unit open in the writer.
bool solve_unit(const DriveTask& task, const Unit& unit, UnitWriter& writer, Progress& progress) {
  const RunIdentity& asked = task.identity;
  std::vector<FrameRepeats> told(unit.frames());
  for (uint32_t repeat = 0; repeat + 1 < asked.repeat; ++repeat) {
    task.simulation.forget();
    for (uint64_t frame = unit.first; frame <= unit.last; ++frame) {
      std::optional<FrameResult> result = solve_repeat(task, unit, frame, repeat, progress);
      if (!result) return false;  // interrupted
      told[frame - unit.first].add(*result);
      task.simulation.give_back(*result);
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
    std::optional<FrameResult> old = writer.take_written();
    if (stop) return frame == unit.last;
    if (old) task.simulation.give_back(*old);
  }
  return true;
}

}  // namespace

Units units_of(const DriveTask& task) {
  return {task.identity.first, task.identity.last, task.run.config.output.shard_frames, task.blocks};
}

Shards shards_of(const DriveTask& task) {
  return {task.run.config.output.directory, task.identity, task.run.summary.inputs, task.run.config.text};
}

void say_damaged(const Shards& shards, Progress& progress) {
  for (const std::string& damage : shards.damaged())
    progress.line(fmt::format("damaged: {}; its frames are computed again", damage));
}

bool compute_unit(const DriveTask& task, const Unit& unit, Interrupted fate, UnitWriter& writer, Progress& progress) {
  const bool whole = solve_unit(task, unit, writer, progress);
  if (whole)
    writer.end();
  else if (fate == Interrupted::drop)
    writer.drop();
  return whole;
}

}  // namespace wavetracer
