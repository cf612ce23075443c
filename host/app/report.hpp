// SPDX-License-Identifier: Apache-2.0
// The closing report of a run, for people: what ran where, how fast, what was found and where it is.
// Everything in it is in summary.json and links.csv, too.
#pragma once
#include <string>
#include "jobs/results.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer::app {

// There must be a frame. verbose: adds what tracing did: rays, sequences, their order, the cache's answers.
std::string report(const Run& run, const Results& results, bool verbose);

}  // namespace wavetracer::app
