// SPDX-License-Identifier: Apache-2.0
// Figures of a link: the result of all paths between one transmitter and one receiver.
// Powers are summed over pairs of ports. docs/formats.md has the formula of each figure.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace wavetracer {

// Delay and Doppler figures are weighted by power; they and the missed share are NaN, and gains are -inf, where no
// power arrives.
struct LinkFigures {
  uint32_t frame = 0, tx = 0, rx = 0;
  uint32_t paths = 0;
  double path_gain_db = 0;        // sum of powers of groups, with fields summed within each (radio/grouped_power.hpp)
  double sum_of_powers_db = 0;    // sum of |a|^2 of all paths, without their phases
  double narrowband_gain_db = 0;  // |h|^2 at the carrier, h = sum a exp(-j 2 pi f tau), with phases
  double mean_delay_s = 0;
  double rms_delay_spread_s = 0;
  double doppler_spread_hz = 0;  // rms about the mean
  bool los = false;              // one of the paths has no interaction
  // Power of the direct path divided by that of all other paths: infinite if there is no other one, NaN without a
  // direct path.
  double k_factor = 0;
  // Estimated power that was missed (wavetracer/missed.hpp), relative to the power that arrives; NaN where it is not
  // known.
  double missed_power_share = 0;
};

// The paths of a frame whose rows the host has not read (Simulation::sum_links).
struct SummedPaths {
  std::vector<LinkFigures> links;   // one entry for each of the frame's links, in their order
  std::array<uint64_t, 6> kinds{};  // the numbers of paths of each of path_kinds (interaction_kinds.hpp)
  double power = 0;                 // sum of |a|^2 of all paths
};

}  // namespace wavetracer
