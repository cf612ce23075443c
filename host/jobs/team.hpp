// What drive.cpp and team.cpp share: units of a task, computed and written.
// Included by these two alone.
#pragma once
#include "jobs/drive.hpp"
#include "jobs/unit_writer.hpp"

namespace wavetracer {

// The files that --resume has found damaged and computes again.
void say_damaged(const Shards& shards, Progress& progress);
Units units_of(const DriveTask& task);
// Solves its frames and hands them to the writer; false where an interrupt came first, which leaves the unit open
// there. last: where not null, gets the figures of its last frame.
bool solve_unit(const DriveTask& task, const Unit& unit, UnitWriter& writer, Progress& progress);
// Solves and writes; false where an interrupt came first.
bool compute_unit(const DriveTask& task, const Unit& unit, UnitWriter& writer, Progress& progress);

}  // namespace wavetracer
