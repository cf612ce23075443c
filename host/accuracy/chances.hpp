// SPDX-License-Identifier: Apache-2.0
// Maps of a receiver grid under errors of the inputs: for each cell the probability that a value reaches a threshold,
// and the mean and the deviation of the path gain. Every sample is a run of its own, and reuses nothing.
#pragma once
#include <string>
#include <vector>
#include "accuracy/inputs.hpp"
#include "coverage/coverage_map.hpp"
#include "study/run.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::accuracy {

struct ChanceRequest {
  InputRequest inputs;  // without discover_every
  std::vector<std::string> thresholds;
  std::string grid, tx;  // empty: the only grid; the strongest transmitter of each cell
};

struct ChanceStudy {
  std::vector<coverage::Map> maps;  // those of the frames that are complete
  bool drive = false;               // frames are a part of a drive
  Varied varied{};
  std::string scene_file;              // empty if the scene is generated
  double nominal_s = 0, sample_s = 0;  // time of the first frame, and average time of a sample
  bool stopped = false;
  std::vector<std::string> warnings = {};
};

// Returns the grid that the maps are of. Throws ConfigError if there is none, or several and none was named.
const ReceiverGridConfig& mapped_grid(const Config& config, const ChanceRequest& request);

// Returns maps of the frames that are complete, even if it was interrupted. Throws ConfigError for thresholds, grids
// and transmitters that there are not, thresholds that need keys that are not set, and configurations whose links
// cannot be summed, and the errors of Simulation.
ChanceStudy study_chances(const ChanceRequest& request, const study::Host& host);

// Returns lines for a terminal: how many cells reach each threshold, and how far path gains deviate.
std::string chances_text(const ChanceStudy& study);

}  // namespace wavetracer::accuracy
