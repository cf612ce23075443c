// SPDX-License-Identifier: Apache-2.0
// The coherent power over the cells of a page's maps (coverage/cell_area.hpp), link by link.
#pragma once
#include <vector>
#include "coverage/cell_area.hpp"
#include "results/saved_run.hpp"
#include "viewer/grid_maps.hpp"

namespace wavetracer {

// The cells of a frame.
class CellAreas {
 public:
  // All arguments outlive this.
  CellAreas(const std::vector<GridMap>& grids, const SavedFrame& frame, double frequency_hz);
  // Returns the levels of the frame's paths of a link; NaN if its receiver is no cell, or if there is no path.
  coverage::AreaLevels levels(const Link& link) const;

 private:
  const std::vector<GridMap>& grids_;
  const Paths& paths_;
  double frequency_hz_;
  std::vector<coverage::CellSides> sides_;  // those of the cells of each grid
  std::vector<size_t> rows_;                // rows of paths, sorted by link
};

}  // namespace wavetracer
