// Figures of a link: what all the paths between one transmitter and one receiver amount to.
// Powers are |a|^2 summed over ports and added over paths without their phases.
#pragma once
#include <cstdint>
#include <vector>

#include "wavetracer/paths.hpp"

namespace wavetracer {

// Delay and Doppler figures are weighted by power; they are NaN, and the gain is -inf, where no power arrives.
struct LinkFigures {
  uint32_t frame = 0, tx = 0, rx = 0;
  uint32_t paths = 0;
  double path_gain_db = 0;
  double mean_delay_s = 0;
  double rms_delay_spread_s = 0;
  double doppler_spread_hz = 0;  // rms about the mean
  bool los = false;              // one of the paths has no interaction
};

// All tx_count * rx_count links of one frame, sorted by tx, then rx; a link without a path is there with paths = 0.
// paths: may hold other frames as well, which are passed over.
std::vector<LinkFigures> link_figures(const Paths& paths, uint32_t frame, uint32_t tx_count, uint32_t rx_count);

}  // namespace wavetracer
