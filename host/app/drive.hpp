// A run of many frames: shard by shard to the disk, so that memory stays flat and a killed run goes on where it was.
// A shard begins at an absolute multiple of output.shard_frames, and cold, so it depends on the configuration alone.
#pragma once
#include "app/frame_range.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "output/manifest.hpp"
#include "output/output.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::app {

// Computes the frames that no finished shard holds and writes all outputs. Of a run that is interrupted these are the
// frames so far; totals.frames of the results says how many, and nothing is written where there are none.
// run: that of the simulation.
Results drive(Simulation& simulation, const Run& run, const RunIdentity& identity, bool resume, Progress& progress);

}  // namespace wavetracer::app
