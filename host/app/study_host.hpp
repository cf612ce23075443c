// SPDX-License-Identifier: Apache-2.0
// Services of the program for `thesis`, `accuracy` and `calibrate`.
#pragma once
#include <filesystem>
#include <string>
#include "jobs/progress.hpp"
#include "study/run.hpp"

namespace wavetracer::app {

// Prints lines, and shows the progress of a task's parts by a bar, or by lines if there is no terminal; if there are
// many figures, each with parts, by a line for each. progress must outlive it.
study::Host study_host(Progress& progress);

// Returns the folder of the results as an absolute path. Throws RuntimeError if it cannot be written to. From now on
// Ctrl-C only stops the study.
std::filesystem::path begin_study(const std::string& directory);

}  // namespace wavetracer::app
