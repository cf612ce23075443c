// SPDX-License-Identifier: Apache-2.0
// A small made-up run for the output tests: two frames, two ends a side, two vehicles, five paths, mixed ports.
// Its values are simple functions of the row, which read_paths.py computes again.
#pragma once
#include <vector>
#include "jobs/shards.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// The first `count` of a launch, a reflection on vehicle 1, a hit on the way out, and another ray's miss.
WaypointRows sample_waypoints(uint32_t frame, size_t count = 4);

struct SampleRun {
  Config config;
  Scene scene;
  std::vector<Instance> instances;
  std::vector<Scene> models;
  SampleRun();
  Run run() const;
  // Frame 7 at 0 s with three paths, frame 8 at 0.1 s with two. The second vehicle is there in frame 8 only.
  std::vector<FrameResult> frames() const;
  // The same world, frame 0, no path.
  std::vector<FrameResult> empty() const;
  // Frames first to first + count - 1 of a drive whose ends, vehicles, links and numbers of paths change with the
  // frame; some frames have no path at all, some no link. With config.output.waypoints each has number % 4 waypoints.
  std::vector<FrameResult> drive(uint32_t first, uint32_t count) const;
};

// Returns the identity of a drive of frames 3 to `last`.
inline RunIdentity sample_identity(uint32_t last) { return {"1.2.3", "0123", "cpu", 3, last, 1}; }

// Merges what the shards have with these frames, the first of a unit that was interrupted in the frame after them.
inline std::vector<std::filesystem::path> merge_interrupted(Shards& shards, const Run& run, Frames unfinished) {
  auto unit = shards.open(run, {unfinished.front().frame, unfinished.back().frame + 1});
  for (const FrameResult& frame : unfinished) unit->add(frame);
  return shards.merge(run, std::move(unit));
}

}  // namespace wavetracer
