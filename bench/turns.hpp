// Frames of several configurations in turn, so that whatever else the machine does meets all of them alike.
// Assumes room for all of them on the device at once.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {

struct Variant {
  std::string name;
  std::function<void(Config&)> change;  // from the configuration that all variants share
};

struct Turns {
  double median_s = 0;  // of warm frames, by wall time
  // Of the seconds of a frame over those of the first variant's frame of the same round: the median, and half its
  // interval of about 95% confidence (R. McGill, J. Tukey, W. Larsen, The American Statistician 32(1), 1978).
  double cost = 1, cost_error = 0;
  FrameResult result;  // of the last round
  Features features;
  std::string device;
};

// One cold frame of each, then `rounds` times a frame of each.
std::vector<Turns> run_in_turn(const Config& common, const std::vector<Variant>& variants, const std::string& device,
                               size_t rounds);

}  // namespace wavetracer::bench
