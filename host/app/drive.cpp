// The loop over units and their frames.
// Assumes that catch_interrupts() was called, so that an interrupt waits for the frame in progress.
#include "app/drive.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <optional>
#include <utility>
#include "app/folder_hold.hpp"
#include "app/interrupt.hpp"
#include "app/solve_frame.hpp"
#include "app/team.hpp"
#include "output/shards.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

constexpr uint32_t most_blocks = 32;

void say_what_is_there(const Shards& shards, const RunIdentity& asked, const std::string& directory,
                       Progress& progress) {
  const uint64_t done = shards.totals().frames, all = FrameRange{asked.first, asked.last}.count();
  if (done == 0)
    progress.line(fmt::format("--resume: no finished shard in {}, so this starts from the beginning", directory));
  else if (done == all)
    progress.line("--resume: all frames are there; the outputs are written again");
  else
    progress.line(fmt::format("--resume: {} of {} frames are there", done, all));
}

void keep_links(Results& results, const std::vector<FrameResult>& frames) {
  if (frames.empty()) return;
  const FrameResult& last = frames.back();
  results.last_frame = last.frame;
  results.last_links = link_figures(last.paths, last.frame, last.world.links);
}

}  // namespace

uint32_t block_count(const Config& config) {
  const auto transmitters = static_cast<uint32_t>(config.transmitters.size());
  if (const std::string why = block_obstacle(config); !why.empty() && transmitters > 1)
    throw ConfigError(
        fmt::format("this run is one frame, which several processes cannot share: {}; run one process "
                    "alone",
                    why));
  return std::clamp(transmitters, 1u, most_blocks);
}

Units units_of(const DriveTask& task) {
  return {task.identity.first, task.identity.last, task.run.config.output.shard_frames, task.blocks};
}

std::vector<FrameResult> solve_unit(const DriveTask& task, const Unit& unit, Progress& progress) {
  std::vector<FrameResult> frames;
  const RunIdentity& asked = task.identity;
  task.simulation.forget();
  if (unit.blocks > 1) {
    const uint64_t all = task.run.config.transmitters.size();
    const TransmitterRange range{static_cast<uint32_t>(all * unit.block / unit.blocks),
                                 static_cast<uint32_t>(all * (unit.block + 1) / unit.blocks)};
    if (interrupted()) return frames;
    frames.push_back(solve_frame(task.simulation, unit.first, asked.repeat, range).result);
    frames[0].missing = task.simulation.explain_missing(frames[0]);
    return frames;
  }
  bool explained = false;
  for (uint64_t frame = unit.first; frame <= unit.last && !interrupted(); ++frame) {
    progress.bar(fmt::format("frame {}", frame), frame - asked.first, FrameRange{asked.first, asked.last}.count());
    frames.push_back(solve_frame(task.simulation, static_cast<uint32_t>(frame), asked.repeat).result);
    // Why a drive has no path at all is asked once a unit; where others have found one, nobody will read it.
    FrameResult& last = frames.back();
    if (explained || last.world.links.empty() || !(last.paths.size() == 0 || asked.first == asked.last)) continue;
    last.missing = task.simulation.explain_missing(last);
    explained = true;
  }
  return frames;
}

bool compute_unit(const DriveTask& task, const Unit& unit, UnitWriter& writer, Progress& progress) {
  std::vector<FrameResult> frames = solve_unit(task, unit, progress);
  if (frames.size() < unit.frames()) return false;
  writer.write(unit, std::move(frames));
  return true;
}

Results drive(const DriveTask& task, Progress& progress) {
  const std::string& directory = task.run.config.output.directory;
  const ProcessInfo process = this_process("", 0);
  Shards shards(directory, task.identity);
  check_not_in_use(shards.folder(), process.job);
  if (task.resume) {
    shards.resume();
    say_what_is_there(shards, task.identity, directory, progress);
  }
  Results results;
  std::optional<FolderHold> folder;
  UnitWriter writer(task.run, shards, progress);
  std::vector<FrameResult> frames;
  const Units units = units_of(task);
  for (uint64_t index = 0; index < units.count() && !interrupted(); ++index) {
    const Unit unit = units.at(index);
    if (shards.finished(unit)) continue;
    frames = solve_unit(task, unit, progress);
    keep_links(results, frames);
    if (frames.size() < unit.frames()) break;
    if (!folder) folder.emplace(directory, process);
    writer.write(unit, std::exchange(frames, {}));
  }
  writer.finish();
  if (folder) folder->keep();
  results.totals = shards.totals();
  add(results.totals, totals_of(frames));
  if (results.totals.frames > 0) {
    progress.line("writing to " + directory);
    results.files = shards.merge(task.run, frames);
  }
  return results;
}

}  // namespace wavetracer::app
