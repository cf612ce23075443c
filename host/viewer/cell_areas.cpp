// SPDX-License-Identifier: Apache-2.0
// Rows of paths are sorted by link here, because those of a file need not be.
#include "viewer/cell_areas.hpp"
#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>

namespace wavetracer {
namespace {

coverage::CellSides cell_sides(const GridSteps& steps) {
  const glm::dvec3 column(steps.column_m, 0), row(steps.row_m, steps.rise_m);
  return {{{glm::normalize(column), glm::normalize(row)}}, {glm::length(column), glm::length(row)}};
}

}  // namespace

CellAreas::CellAreas(const std::vector<GridMap>& grids, const SavedFrame& frame, double frequency_hz)
    : grids_(grids), paths_(frame.paths), frequency_hz_(frequency_hz), rows_(frame.paths.size()) {
  for (const GridMap& grid : grids) sides_.push_back(cell_sides(steps_of(grid, frame.receiver_position_m)));
  std::iota(rows_.begin(), rows_.end(), size_t{0});
  std::ranges::stable_sort(rows_, {}, [this](size_t row) { return Link{paths_.tx[row], paths_.rx[row]}; });
}

coverage::AreaLevels CellAreas::levels(const Link& link) const {
  const auto grid =
      std::ranges::find_if(grids_, [&](const GridMap& each) { return link.rx - each.first < each.count(); });
  if (grid == grids_.end()) return {};
  const auto own = std::ranges::equal_range(rows_, link, {}, [this](size_t row) {
    return Link{paths_.tx[row], paths_.rx[row]};
  });
  return coverage::area_levels(paths_, std::span(own.begin(), own.end()), frequency_hz_,
                               sides_[static_cast<size_t>(grid - grids_.begin())]);
}

}  // namespace wavetracer
