// SPDX-License-Identifier: Apache-2.0
// Measures the user's own scene at many settings: the time of a frame, and its error against the reference.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>
#include "accuracy/measure.hpp"
#include "study/path_error.hpp"
#include "study/run.hpp"

namespace wavetracer::accuracy {

struct Request {
  std::string file;               // file of the configuration
  std::vector<std::string> sets;  // in the form of --set
  study::RayRange rays = default_rays;
  bool certify = false;  // rays are compared with beams, which miss nothing
  std::string device;
  uint32_t frames = 5, repeats = 3;
  std::string command_line;  // printed on the page
};

struct Row {
  Setting setting;
  bool reference = false;  // it is the reference of its axis; rays, auto and reuse share one
  bool own = false;        // it has the user's own settings
  double frame_s = study::undefined;
  uint64_t paths = 0;
  study::PathError error;
  std::string refusal;                // the reason if it was not measured, else empty
  std::vector<std::string> warnings;  // warnings of its frames

  bool measured() const { return refusal.empty(); }
};

struct Study {
  DeviceSummary device;
  std::string config_file, scene;
  uint64_t frames = 0, links = 0;  // frames on which every setting was measured; links of these frames
  uint32_t repeats = 0;
  std::vector<Row> rows;
  size_t planned = 0;
  bool drive = false;  // frames are a part of a drive
};

// Returns complete rows, even if it was interrupted. keep: called on another thread with the rows so far, if the user
// wants to stop while kernels are compiled, which ends the program. Throws ConfigError if there is no link, or no path
// at any reference, and the errors of Simulation for the user's own settings.
Study study(const Request& request, const study::Host& host, const std::function<void(const Study&)>& keep = {});

}  // namespace wavetracer::accuracy
