// SPDX-License-Identifier: Apache-2.0
// Measures frames of several configurations alternately, so that other load of the machine affects all of them. All
// must fit on the device at once.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {

struct Variant {
  std::string name;
  std::function<void(Config&)> change;  // changes the configuration that all variants share
};

struct Turns {
  double median_s = 0;  // median of warm frames, by wall time
  // Ratio of a frame's seconds to those of the first variant's frame in the same round: the median, and half its
  // interval of about 95% confidence (R. McGill, J. Tukey, W. Larsen, The American Statistician 32(1), 1978).
  double cost = 1, cost_error = 0;
  FrameResult result;  // result of the last round
  Features features;
  std::string device;
};

// Runs one cold frame of each, then `rounds` times a frame of each.
std::vector<Turns> run_in_turn(const Config& common, const std::vector<Variant>& variants, const std::string& device,
                               size_t rounds);

}  // namespace wavetracer::bench
