// What drive.cpp and team.cpp share: units of a task, computed and written.
// Included by these two alone.
#pragma once
#include "app/drive.hpp"
#include "app/unit_writer.hpp"

namespace wavetracer::app {

Units units_of(const DriveTask& task);
// Its frames, all of them unless interrupted.
std::vector<FrameResult> solve_unit(const DriveTask& task, const Unit& unit, Progress& progress);
// Solves and writes; false where an interrupt came first.
bool compute_unit(const DriveTask& task, const Unit& unit, UnitWriter& writer, Progress& progress);

}  // namespace wavetracer::app
