// SPDX-License-Identifier: Apache-2.0
// Computes one unit of a run: solves its frames, repeated as --repeat says, and hands them to the writer.
// drive.cpp and team.cpp share these functions; they differ in how a process comes to its units.
#pragma once
#include "jobs/drive.hpp"
#include "jobs/unit_writer.hpp"

namespace wavetracer {

Units units_of(const DriveTask& task);
// Returns the folder of the task's shards; no file is touched yet.
Shards shards_of(const DriveTask& task);
// Reports the files that --resume has found damaged and computes again.
void say_damaged(const Shards& shards, Progress& progress);

// The fate of the frames that were solved if an interrupt ends a unit early.
enum class Interrupted {
  drop,  // they are lost: the unit is computed again as a whole
  keep   // they stay in the writer, see UnitWriter::take_unfinished(): the outputs get them
};

// Solves the unit's frames and hands them to the writer. Returns false if an interrupt came before its last frame.
bool compute_unit(const DriveTask& task, const Unit& unit, Interrupted fate, UnitWriter& writer, Progress& progress);

}  // namespace wavetracer
