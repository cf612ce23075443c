// A run in units, shards of frames or blocks of transmitters: unit by unit to the disk, so that memory stays flat, a
// killed run goes on where it was, and any number of processes can share it (jobs/units.hpp).
#pragma once
#include "jobs/frame_range.hpp"
#include "jobs/manifest.hpp"
#include "jobs/process_files.hpp"
#include "jobs/progress.hpp"
#include "jobs/ranks.hpp"
#include "jobs/results.hpp"
#include "wavetracer/output.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// The blocks that a frame of this configuration is shared by: as many as there are transmitters, at most 32, whoever
// computes them. Throws ConfigError where its links belong together.
uint32_t block_count(const Config& config);

// A world where nothing moves: one frame, written as it is. run.summary.repeat_count becomes what was done where the
// run is interrupted; nothing is written where there is no frame.
Results run_still(Simulation& simulation, Run& run, Progress& progress);

struct DriveTask {
  Simulation& simulation;
  const Run& run;  // that of the simulation
  RunIdentity identity;
  bool resume = false;
  uint32_t blocks = 1;  // more than one: of the one frame
};

// This process alone: computes the frames that no finished shard holds and writes all outputs. Of a run that is
// interrupted these are the frames so far; totals.frames of the results says how many, and nothing is written where
// there are none.
Results drive(const DriveTask& task, Progress& progress);

// What one of several processes has done.
struct Shared {
  Results results;        // of all of them, where this one has merged; else without frames
  uint64_t missing = 0;   // units that no process could compute, or that were left when this one was interrupted
  uint64_t units = 0;     // of a part: how many it has
  bool unmerged = false;  // interrupted while nothing was missing and nobody had merged yet
};

// With the other ranks of its job: takes units that nobody has until all are finished. The first one to come prepares
// the merge meanwhile, and merges; if it dies, the first of the others to see that does. Units of ranks that die are
// taken over, once.
// me: has its file in the folder.
Shared drive_together(const DriveTask& task, const Ranks& ranks, const ProcessInfo& me, Progress& progress);

// Part K of N: the units u with u mod N = K, and no outputs. Processes need not know of each other.
Shared drive_part(const DriveTask& task, const ShardChoice& part, Progress& progress);

}  // namespace wavetracer
