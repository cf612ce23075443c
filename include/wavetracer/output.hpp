// SPDX-License-Identifier: Apache-2.0
// The results of a run and the call that writes them to a folder, as `wavetracer run` does.
// All frames of one run share their scene, vehicles, radio ends and port counts.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/simulation.hpp"
#include "wavetracer/version.hpp"

namespace wavetracer {

// A file that a run has read.
struct InputFile {
  std::string name;  // the key that names it; for a file that another file names, also its path: "scene.file: a.ply"
  std::string file;
  uint64_t bytes = 0, hash = 0;  // length and hash of its content
  bool operator==(const InputFile&) const = default;
};

// Information about a run besides its world and its frames.
struct RunSummary {
  std::string version = WAVETRACER_VERSION;
  DeviceSummary device;
  OrderSummary order;
  double diffraction_range_db = 0;  // as trace.diffraction_range_db asks or "auto" chose; 0: no path is left out
  uint64_t edge_rays = 0;  // from each edge, as trace.edge_rays asks or "auto" chose; 0: receivers launched rays
  Features features;
  StageSeconds setup_seconds;  // stages outside the frames: load, build, compile, ...
  std::string command_line;
  std::vector<InputFile> inputs;
  uint64_t frames_asked = 1;
  uint32_t repeat_count = 1;          // number of times that each frame was computed; its seconds are medians
  std::vector<std::string> warnings;  // warnings of the run; frames have their own
};

// The data that all frames of a run share. It refers to the simulation that it was made from, which must live longer.
struct Run {
  const Config& config;  // includes the ends that are mounted on vehicles
  const Scene& scene;
  const std::vector<Instance>& instances;
  const std::vector<Scene>& models;
  RunSummary summary;
  std::vector<SensedTarget> targets = {};
  std::vector<RadarAxes> radars = {};  // one for each [[radar]]
};

// Makes the Run from a simulation; the outputs name command_line as their origin.
Run make_run(const Simulation& simulation, uint64_t frames_asked = 1, const std::string& command_line = "");

// Consecutive frames, sorted by their number.
using Frames = std::span<const FrameResult>;

// Writes paths.h5, waypoints.h5 and cache_entries.h5 (if output.waypoints and output.cache_entries ask for them),
// links.csv and summary.json of a run that fits in memory. They replace everything that an earlier run left there.
// Returns their paths in that order. The folder is created if it is missing. A file appears under its name only when
// all are complete and on the disk; after a failure neither temporary files nor a folder made here are left. Throws
// RuntimeError. It must not be called from two threads at once: the HDF5 library is not thread safe.
std::vector<std::filesystem::path> write_outputs(const std::filesystem::path& directory, const Run& run, Frames frames);

}  // namespace wavetracer
