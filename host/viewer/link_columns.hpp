// SPDX-License-Identifier: Apache-2.0
// The columns of a page's links, as data.js reads them: those that every run has, and those of beams and of the areas
// of cells where the run has them.
#pragma once
#include <cmath>
#include <cstdint>
#include "coverage/cell_area.hpp"
#include "results/link_rows.hpp"
#include "viewer/blocks.hpp"

namespace wavetracer {

class LinkColumns {
 public:
  // Bytes of a link: in any case, and those of either kind of further columns.
  static constexpr uint64_t bytes = 37, more_bytes = 8;

  // frame: row of the frame on the page. area: that of the cell; NaN for other receivers.
  void add(size_t frame, const LinkRow& row, const coverage::AreaLevels& area) {
    frame_.add(static_cast<uint32_t>(frame));
    tx_.add(row.link.tx);
    rx_.add(row.link.rx);
    paths_.add(row.paths);
    gain_.add(static_cast<float>(row.path_gain_db));
    narrowband_.add(static_cast<float>(row.narrowband_gain_db));
    spread_.add(static_cast<float>(row.rms_delay_spread_s));
    missed_.add(static_cast<float>(row.missed_power_share));
    k_factor_.add(static_cast<float>(row.k_factor));
    los_.add(uint8_t{row.los});
    beam_gain_.add(static_cast<float>(row.beam_gain_db));
    tx_beam_.add(static_cast<uint16_t>(row.tx_beam.value_or(0)));
    rx_beam_.add(static_cast<uint16_t>(row.rx_beam.value_or(0)));
    cell_mean_.add(static_cast<float>(area.cell_mean_db));
    fading_.add(static_cast<float>(area.fading_db));
    beams_ = beams_ || !std::isnan(row.beam_gain_db);
    areas_ = areas_ || !std::isnan(area.cell_mean_db);
  }
  // Tell whether the block has these columns: one of its links has a value there.
  bool beams() const { return beams_; }
  bool areas() const { return areas_; }
  // Returns the columns, those of more bytes first, so that all are aligned.
  Packer block() const {
    Packer out;
    for (const Packer* column : {&frame_, &tx_, &rx_, &paths_, &gain_, &narrowband_, &spread_, &missed_, &k_factor_})
      out.append(*column);
    if (areas_) out.append(cell_mean_), out.append(fading_);
    if (beams_) out.append(beam_gain_), out.append(tx_beam_), out.append(rx_beam_);
    out.append(los_);
    return out;
  }

 private:
  Packer frame_, tx_, rx_, paths_, gain_, narrowband_, spread_, missed_, k_factor_, los_;
  Packer beam_gain_, tx_beam_, rx_beam_, cell_mean_, fading_;
  bool beams_ = false, areas_ = false;
};

}  // namespace wavetracer
