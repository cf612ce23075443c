// SPDX-License-Identifier: Apache-2.0
// Services of the program for `thesis` and `accuracy`.
#pragma once
#include "jobs/progress.hpp"
#include "study/run.hpp"

namespace wavetracer::app {

// Prints lines, and shows the progress of a task's parts by a bar, or by lines if there is no terminal; if there are
// many figures, each with parts, by a line for each. progress must outlive it.
study::Host study_host(Progress& progress);

}  // namespace wavetracer::app
