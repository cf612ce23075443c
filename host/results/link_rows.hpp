// SPDX-License-Identifier: Apache-2.0
// The figures of a frame's links for pages and maps: those of links.csv, which includes all paths, or, without that
// file, those of the paths in paths.h5. docs/formats.md defines them.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>
#include "results/link_table.hpp"
#include "results/saved_run.hpp"

namespace wavetracer {

struct LinkRow {
  Link link;
  uint32_t paths = 0;
  bool los = false;
  // Fields within a group are added, then powers of groups.
  double path_gain_db = -std::numeric_limits<double>::infinity();
  double narrowband_gain_db = -std::numeric_limits<double>::infinity();  // coherent sum at the carrier
  double rms_delay_spread_s = std::numeric_limits<double>::quiet_NaN();  // NaN if no power arrives
  double left_out_power_share = 0;  // share of the power of all paths that paths.h5 lacks because of limits of output
  double missed_power_share = std::numeric_limits<double>::quiet_NaN();  // NaN if unknown
  // Power of the direct path divided by that of all other paths, as a ratio of powers: infinite if there is no other
  // one; NaN without a direct path.
  double k_factor = std::numeric_limits<double>::quiet_NaN();
  // The best pair of beams, and its gain: NaN where neither end has a codebook, and without links.csv. Without a path
  // the gain is minus infinity, and there is no pair.
  std::optional<uint32_t> tx_beam = {}, rx_beam = {};
  double beam_gain_db = std::numeric_limits<double>::quiet_NaN();
};

// Returns every link that was computed or has a path, sorted. first_link: row of the frame's first link in the table.
// frequency_hz: of the carrier.
std::vector<LinkRow> link_rows(const SavedFrame& frame, const LinkTable& table, uint64_t first_link,
                               double frequency_hz);

}  // namespace wavetracer
