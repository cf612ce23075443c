// SPDX-License-Identifier: Apache-2.0
// Runs in units, which are shards of frames or blocks of transmitters: each is written to disk, so that memory does not
// grow, a killed run can continue, and any number of processes can share it (jobs/units.hpp).
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

// Returns the number of blocks that processes share a frame of this configuration by: as many as there are
// transmitters, at most 32, whatever the number of processes. Throws ConfigError if its links depend on each other.
uint32_t block_count(const Config& config);

// Runs a world where nothing moves: one frame, which is written at once. If the run is interrupted,
// run.summary.repeat_count becomes the number of finished repeats; nothing is written if there is no frame.
Results run_still(Simulation& simulation, Run& run, Progress& progress);

struct DriveTask {
  Simulation& simulation;
  const Run& run;  // that of the simulation
  RunIdentity identity;
  bool resume = false;
  uint32_t blocks = 1;  // more than one only if there is one frame
};

// Computes, in this process alone, the frames that no finished shard holds and writes all outputs. If the run is
// interrupted, these have the frames so far; totals.frames of the results gives their number, and nothing is written if
// there are none.
Results drive(const DriveTask& task, Progress& progress);

// The result of one of several processes.
struct Shared {
  Results results;        // results of all processes if this one has merged; else without frames
  uint64_t missing = 0;   // units that no process could compute, or that were left when this one was interrupted
  uint64_t units = 0;     // for a part: its number of units
  bool unmerged = false;  // it was interrupted while nothing was missing and no process had merged yet
};

// Computes together with the other ranks of its job: takes free units until all are finished. The first process to come
// prepares the merge meanwhile, and merges; if it dies, the first other process that notices it merges. Units of ranks
// that die are taken over once.
// me: this process, which must have its file in the folder.
Shared drive_together(const DriveTask& task, const Ranks& ranks, const ProcessInfo& me, Progress& progress);

// Computes part K of N: the units u with u mod N = K, without outputs. Processes need not know of each other.
Shared drive_part(const DriveTask& task, const ShardChoice& part, Progress& progress);

}  // namespace wavetracer
