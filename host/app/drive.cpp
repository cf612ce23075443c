// The loop over shards and their frames.
// Assumes that catch_interrupts() was called, so that an interrupt waits for the frame in progress.
#include "app/drive.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "app/interrupt.hpp"
#include "app/solve_frame.hpp"
#include "output/shards.hpp"

namespace wavetracer::app {
namespace {

// The frames of the shard that begins with `first`.
FrameRange shard_of(uint32_t first, uint32_t last, uint32_t shard_frames) {
  const uint64_t end = (uint64_t{first} / shard_frames + 1) * shard_frames;
  return {first, static_cast<uint32_t>(std::min<uint64_t>(end - 1, last))};
}

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

// Its frames, all of them unless interrupted.
std::vector<FrameResult> solve_shard(Simulation& simulation, const FrameRange& range, const RunIdentity& asked,
                                     Progress& progress) {
  std::vector<FrameResult> frames;
  simulation.forget();
  for (uint64_t frame = range.first; frame <= range.last && !interrupted(); ++frame) {
    progress.bar(fmt::format("frame {}", frame), frame - asked.first, FrameRange{asked.first, asked.last}.count());
    frames.push_back(solve_frame(simulation, static_cast<uint32_t>(frame), asked.repeat).result);
  }
  return frames;
}

void keep_links(Results& results, const std::vector<FrameResult>& frames) {
  if (frames.empty()) return;
  const FrameResult& last = frames.back();
  results.last_frame = last.frame;
  results.last_links = link_figures(last.paths, last.frame, last.world.links);
}

}  // namespace

Results drive(Simulation& simulation, const Run& run, const RunIdentity& identity, bool resume, Progress& progress) {
  const std::string& directory = run.config.output.directory;
  Shards shards(directory, identity);
  if (resume) {
    shards.resume();
    say_what_is_there(shards, identity, directory, progress);
  }
  Results results;
  std::vector<FrameResult> frames;
  for (uint64_t first = identity.first; first <= identity.last && !interrupted();) {
    const FrameRange range = shard_of(static_cast<uint32_t>(first), identity.last, run.config.output.shard_frames);
    first = uint64_t{range.last} + 1;
    if (shards.finished(range.first)) continue;
    frames = solve_shard(simulation, range, identity, progress);
    keep_links(results, frames);
    if (frames.size() < range.count()) break;
    shards.write(run, frames);
    progress.line(fmt::format("frames {} to {}: {} paths", range.first, range.last, totals_of(frames).counts.paths));
    frames.clear();
  }
  results.totals = shards.totals();
  add(results.totals, totals_of(frames));
  if (results.totals.frames > 0) {
    progress.line("writing to " + directory);
    results.files = shards.merge(run, frames);
  }
  return results;
}

}  // namespace wavetracer::app
