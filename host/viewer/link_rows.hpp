// The links of a frame in figures, for the page: those of all its paths, the ones that the page leaves out included.
// Figures are those of links.csv: docs/formats.md.
#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>
#include "results/saved_run.hpp"

namespace wavetracer {

struct LinkRow {
  Link link;
  uint32_t paths = 0;
  bool los = false;
  double power = 0;
  double rms_delay_spread_s = std::numeric_limits<double>::quiet_NaN();  // where no power arrives
  double missed_power_share = std::numeric_limits<double>::quiet_NaN();  // where that is not known
  double narrowband_gain_db = -std::numeric_limits<double>::infinity();  // coherent, at the carrier
  double gain_db() const;                                                // -inf where no power arrives
};

// Every link that was asked for or has a path, sorted. missed_power_share: one per link of frame.links, or empty.
// frequency_hz: of the carrier.
std::vector<LinkRow> link_rows(const SavedFrame& frame, std::span<const double> missed_power_share,
                               double frequency_hz);

}  // namespace wavetracer
