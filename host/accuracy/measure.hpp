// The frames of one setting: what they find, and how long they take.
// Every frame that counts is solved again and again, cold but for the device, unless the setting is about reuse.
#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>
#include "accuracy/axes.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::accuracy {

struct Measured {
  DeviceSummary device;
  std::vector<Paths> frames;
  uint64_t paths = 0, links = 0;  // of these frames; links that are wanted
  uint64_t world_frames = 1;      // of which these are some
  double frame_s = 0;             // median of warm frames
  std::string refusal;            // why nothing was measured; empty: it was
  std::vector<std::string> warnings;
};

// The middles of `count` equal parts of a drive, or all frames of a shorter one.
std::vector<uint32_t> spread_frames(uint64_t of, uint32_t count);

struct How {
  std::string device;  // as Simulation takes it
  uint32_t frames = 5, repeats = 3;
  std::function<bool()> interrupted;
};

// Nothing where it was interrupted. A frame of more than two seconds is solved once.
std::optional<Measured> measure(const Config& config, const Setting& setting, const How& how);

}  // namespace wavetracer::accuracy
