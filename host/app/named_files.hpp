// Checks of a config against the file system, shared by `run` and `validate`.
// They need no device and load nothing, so that a mistake in a name costs no time.
#pragma once
#include <filesystem>
#include <string>
#include "wavetracer/config.hpp"

namespace wavetracer::app {

// Every file that the config names is there and readable; scene.generate and trajectories.generate are understood and
// have the same streets. Throws InputError or ConfigError.
void check_inputs(const Config& config);

// trace.rays: a number, or auto.
std::string rays_in_words(const TraceConfig& trace);

// The folder, or the nearest that exists above it, can be written to. Throws RuntimeError.
void check_output_folder(const std::filesystem::path& folder);

}  // namespace wavetracer::app
