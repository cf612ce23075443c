// What is said of links without a path once a run is done.
// Of drives only where no link has one in any frame: vehicles that hide from each other are normal.
#pragma once
#include <string>
#include <vector>
#include "app/report.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::app {

// The run with these words among its warnings, for its summary.json; the results get them, too.
Run with_missing_words(const Simulation& simulation, const Run& run, Results& results);

}  // namespace wavetracer::app
