// The links of a frame in figures, for the page: those of links.csv, which is made of all paths, and where that is not
// there those of the paths in paths.h5. docs/formats.md defines them.
#pragma once
#include <cstdint>
#include <limits>
#include <vector>
#include "results/link_table.hpp"
#include "results/saved_run.hpp"

namespace wavetracer {

struct LinkRow {
  Link link;
  uint32_t paths = 0;
  bool los = false;
  double path_gain_db = -std::numeric_limits<double>::infinity();        // fields of a group added, then powers
  double narrowband_gain_db = -std::numeric_limits<double>::infinity();  // coherent, at the carrier
  double rms_delay_spread_s = std::numeric_limits<double>::quiet_NaN();  // where no power arrives
  double missed_power_share = std::numeric_limits<double>::quiet_NaN();  // where that is not known
};

// Every link that was asked for or has a path, sorted. first_link: of the frame among the rows of the table.
// frequency_hz: of the carrier.
std::vector<LinkRow> link_rows(const SavedFrame& frame, const LinkTable& table, uint64_t first_link,
                               double frequency_hz);

}  // namespace wavetracer
