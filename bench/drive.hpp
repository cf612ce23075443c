// A drive, frame by frame, under one setting of rays after another: seconds per frame, and how many of the paths of
// frames with many more rays are found. Assumes a quiet machine.
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
  Config config;  // rays, reuse and refreshing ones are those of the settings
  uint32_t frames = 30;
};

struct Setting {
  bool reuse = false;
  std::optional<uint64_t> rays = {},
                          refresh_rays = {};  // a transmitter; not given: "auto", and what the simulation chooses
  std::string baseline = {};
  std::optional<double> baseline_s = {};
};

// Paths of the frames that are compared, each frame cold.
using References = std::map<uint32_t, Paths>;

// The frames 5, 10, 20 and the last one of a drive, as far as it has them.
std::vector<uint32_t> compared_frames(uint32_t frames);
// Empty where rays is 0: then nothing is compared.
References solve_references(const Drive& drive, uint64_t rays, const std::string& device);

// Prints a line; returns the median seconds per frame. With reuse all frames are run in order, the first of them twice:
// to warm up, and as the cold frame. Without, all are cold and only the compared ones are run. The error is 1 - the
// power recall of the last frame.
double measure(const Drive& drive, const Setting& setting, const References& references, const std::string& device,
               const std::string& command);

}  // namespace wavetracer::bench
