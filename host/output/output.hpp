// The results of a run and the one call that writes them to a folder.
// All frames of one run share their scene, radio ends and port counts.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/simulation.hpp"
#include "wavetracer/version.hpp"

namespace wavetracer {

// What is known about a run beyond its frames.
struct RunSummary {
  std::string version = WAVETRACER_VERSION;
  DeviceSummary device;
  OrderSummary order;
  StageSeconds setup_seconds;  // stages outside the frames: load, build, compile, ...
  std::string command_line;
  uint32_t repeat_count = 1;          // how often each frame was solved; its seconds are medians
  std::vector<std::string> warnings;  // those of the run; frames bring their own
};

struct RunData {
  const Config& config;
  const Scene& scene;
  RunSummary summary;
  std::vector<FrameResult> frames;
  uint32_t first_frame = 0;          // the number of frames[0]; the others follow it one by one
  std::vector<double> frame_time_s;  // one a frame; empty: the world stands still at 0 s

  double time_s(size_t frame_index) const { return frame_time_s.empty() ? 0.0 : frame_time_s[frame_index]; }
};

// Writes paths.h5, links.csv and summary.json, replacing earlier ones, and returns their paths in that order.
// The folder is created where it is missing. A file appears under its name only when all three are whole and on the
// disk; after a failure neither temporary files nor a folder made here are left. Throws RuntimeError.
// Not to be called from two threads at once: the HDF5 library is not thread safe.
std::vector<std::filesystem::path> write_outputs(const std::filesystem::path& directory, const RunData& run);

}  // namespace wavetracer
