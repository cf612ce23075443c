// SPDX-License-Identifier: Apache-2.0
// Power over delay: the shape of what arrives at a place, in bins of delay.
#pragma once
#include <span>
#include <vector>

namespace wavetracer::calibration {

struct DelayPower {
  double delay_s = 0, power = 0;
};

// Bins below this much of the whole power are no data, and an earlier component below it does not begin the profile.
constexpr double profile_range_db = 25;
// The least level of a bin: weaker ones have it, too.
constexpr double least_bin_db = -40;

// Returns the power of each bin, in dB of the power in all of them; nothing if nothing arrives. Bin k is a triangle
// around k bins of delay after the first component that has at least the range of the whole power, so that the powers
// change continuously with the delays. Components before it are in bin 0, and those after the last bin in none.
// bin_s: more than 0.
std::vector<double> delay_profile(std::span<const DelayPower> components, double bin_s, size_t bins);

// Returns the number of bins that hold all components. most: it is not more than this.
size_t bins_of(std::span<const DelayPower> components, double bin_s, size_t most);

}  // namespace wavetracer::calibration
