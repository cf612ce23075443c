// What the program lends to `bench` and `accuracy`.
#pragma once
#include "jobs/progress.hpp"
#include "study/run.hpp"

namespace wavetracer::app {

// Says lines, and shows how far a task is: its parts by a bar, or lines where there is no terminal; of many figures,
// each of which has parts, a line for each. progress must outlive it.
study::Host study_host(Progress& progress);

}  // namespace wavetracer::app
