// SPDX-License-Identifier: Apache-2.0
// Figures of a link: the result of all paths between one transmitter and one receiver.
// Powers are summed over pairs of ports. docs/formats.md has the formula of each figure.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "wavetracer/paths.hpp"
#include "wavetracer/world_state.hpp"

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
  // Estimated power that was missed (wavetracer/missed.hpp), relative to the power that arrives; NaN where it is not
  // known.
  double missed_power_share = 0;
};

// One entry for each of the frame's links, in their order; a link without a path is there with paths = 0.
// links: sorted, as in WorldState. paths: sorted as Paths says; rows of other frames and other links are skipped.
std::vector<LinkFigures> link_figures(const Paths& paths, uint32_t frame, std::span<const Link> links,
                                      double frequency_hz);

}  // namespace wavetracer
