// SPDX-License-Identifier: Apache-2.0
// Checks a config against the file system, for `run` and `validate`.
// The checks need no device and load nothing, so that a mistake in a name is reported at once.
#pragma once
#include <filesystem>
#include <string>
#include "wavetracer/config.hpp"

namespace wavetracer::app {

// Checks that every file of the config exists and is readable, that scene.generate and trajectories.generate can be
// parsed, and that both have the same streets. Throws InputError or ConfigError.
void check_inputs(const Config& config);

// Returns what an end sends out in search of paths: a number of rays, "auto rays", "beams", or both
// where the choice waits for the scene.
std::string launch_in_words(const TraceConfig& trace);

// Checks that the folder, or its nearest existing ancestor, can be written to. Throws RuntimeError.
void check_output_folder(const std::filesystem::path& folder);

}  // namespace wavetracer::app
