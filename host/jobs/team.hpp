// SPDX-License-Identifier: Apache-2.0
// Functions that drive.cpp and team.cpp share: units of a task are computed and written.
// Only these two include it.
#pragma once
#include "jobs/drive.hpp"
#include "jobs/unit_writer.hpp"

namespace wavetracer {

// Reports the files that --resume has found damaged and computes again.
void say_damaged(const Shards& shards, Progress& progress);
Units units_of(const DriveTask& task);
// Solves the unit's frames and hands them to the writer; returns false if an interrupt came first, which leaves the
// unit open in the writer. last: if not null, gets the figures of its last frame.
bool solve_unit(const DriveTask& task, const Unit& unit, UnitWriter& writer, Progress& progress);
// Solves and writes a unit; returns false if an interrupt came first.
bool compute_unit(const DriveTask& task, const Unit& unit, UnitWriter& writer, Progress& progress);

}  // namespace wavetracer
