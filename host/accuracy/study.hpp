// A scene of the user's own at many settings: the time of a frame, and what it gets wrong against the reference.
#pragma once
#include <optional>
#include <string>
#include <vector>
#include "accuracy/measure.hpp"
#include "study/path_error.hpp"
#include "study/run.hpp"

namespace wavetracer::accuracy {

struct Request {
  std::string file;               // of the configuration
  std::vector<std::string> sets;  // as --set takes them
  study::RayRange rays = default_rays;
  std::string device;
  uint32_t frames = 5, repeats = 3;
  std::string command_line;  // for the page
};

struct Row {
  Setting setting;
  bool reference = false;  // of its axis; rays, auto and reuse share one
  bool own = false;        // the user's own settings
  double frame_s = study::undefined;
  uint64_t paths = 0;
  study::PathError error;
  std::string refusal;                // why it was not measured; empty: it was
  std::vector<std::string> warnings;  // of its frames

  bool measured() const { return refusal.empty(); }
};

struct Study {
  DeviceSummary device;
  std::string config_file, scene;
  uint64_t frames = 0, links = 0;  // that every setting was measured on; links of these frames
  uint32_t repeats = 0;
  std::vector<Row> rows;
  size_t planned = 0;
  bool drive = false;  // frames are some of a drive
};

// Rows are complete, also where it was interrupted. Throws ConfigError where there is no link, or no path at any
// reference; and what the user's own settings make Simulation throw.
Study study(const Request& request, const study::Host& host);

}  // namespace wavetracer::accuracy
