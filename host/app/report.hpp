// The closing words of a run, for people: what ran where, how fast, what was found and where it is.
// Everything in it stands in summary.json and links.csv, too.
#pragma once
#include <string>
#include "jobs/results.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer::app {

// At least one frame. verbose: what tracing did, too: rays, sequences, how they were ordered, what a cache answered.
std::string report(const Run& run, const Results& results, bool verbose);

}  // namespace wavetracer::app
