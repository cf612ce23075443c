// SPDX-License-Identifier: Apache-2.0
// Runs a drive frame by frame, under several settings of rays: seconds per frame, and the share found of the paths of
// frames with many more rays. The machine must be quiet.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "wavetracer/config.hpp"
#include "wavetracer/paths.hpp"

namespace wavetracer::bench {

struct Drive {
  std::string name = {};
  Config config;  // rays, reuse and refresh_rays come from the settings
  uint32_t frames = 30;
};

struct Setting {
  bool reuse = false;
  std::optional<uint64_t> rays = {},
                          refresh_rays = {};  // per transmitter; not given: "auto", and the simulation's choice
  std::string baseline = {};
  std::optional<double> baseline_s = {};
};

// Paths of the frames that are compared; each frame is cold.
using References = std::map<uint32_t, Paths>;

// Returns the frames 5, 10, 20 and the last one of a drive, as far as they exist.
std::vector<uint32_t> compared_frames(uint32_t frames);
// Empty if rays is 0: then nothing is compared.
References solve_references(const Drive& drive, uint64_t rays, const std::string& device);

// Prints a line; returns the median seconds per frame. With reuse, all frames are run in order, the first of them
// twice: to warm up, and as the cold frame. Without reuse, all frames are cold and only the compared ones are run. The
// error is 1 - the power recall of the last frame.
double measure(const Drive& drive, const Setting& setting, const References& references, const std::string& device,
               const std::string& command);

}  // namespace wavetracer::bench
