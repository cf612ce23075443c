// SPDX-License-Identifier: Apache-2.0
// Measures the frames of one setting: the paths that they find, and their time.
// Every counted frame is solved again and again without results of earlier frames but on a warm device, unless the
// setting is about reuse.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>
#include "accuracy/axes.hpp"
#include "study/run.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::accuracy {

struct Measured {
  DeviceSummary device;
  uint64_t edge_rays = 0;  // see Simulation::edge_rays
  std::vector<Paths> frames;
  uint64_t paths = 0, links = 0;  // paths of these frames; links that were asked for
  uint64_t world_frames = 1;      // number of frames of the world, which these are a part of
  double frame_s = 0;             // median of warm frames
  std::string refusal;            // the reason if nothing was measured, else empty
  std::vector<std::string> warnings;
};

// Returns the middles of `count` equal parts of a drive, or all frames of a shorter one.
std::vector<uint32_t> spread_frames(uint64_t of, uint32_t count);

struct How {
  std::string device;  // in the form of Simulation's argument
  uint32_t frames = 5, repeats = 3;
  const study::Host& host;
  // Called on another thread before the program ends, if the user wants to stop while kernels are compiled.
  std::function<void()> keep = {};
};

// Returns nothing if it was interrupted. A frame of more than two seconds is solved once.
std::optional<Measured> measure(const Config& config, const Setting& setting, const How& how);

}  // namespace wavetracer::accuracy
