// SPDX-License-Identifier: Apache-2.0
// A grid begins with a cell 0,0 and ends where the next name is not that of the next cell.
// If its last row is incomplete, it is no grid: its receivers are then ordinary ends.
#include "viewer/grid_maps.hpp"
#include <algorithm>
#include "simulation/receiver_grid.hpp"
#include "viewer/blocks.hpp"

namespace wavetracer {
namespace {

constexpr uint32_t least_cells = 4;

// Returns the grid whose cell 0,0 is receiver `first`; count() = 0 if there is none.
GridMap grid_from(const std::vector<RadioEnd>& receivers, uint32_t first) {
  const std::string& name = receivers[first].name;
  constexpr std::string_view begin = "/0,0";
  if (name.size() <= begin.size() || !name.ends_with(begin)) return {};
  GridMap grid{name.substr(0, name.size() - begin.size()), first, 0, 0};
  uint32_t cells = 0;
  for (size_t i = first; i < receivers.size(); ++i, ++cells) {
    const auto cell = grid_cell(grid.name, receivers[i].name);
    if (!cell) break;
    if (cell->iy == 0 && cell->ix == cells)
      ++grid.columns;
    else if (cell->ix != cells % grid.columns || cell->iy != cells / grid.columns)
      break;
  }
  if (cells < least_cells || cells % grid.columns != 0) return {};
  grid.rows = cells / grid.columns;
  return grid;
}

}  // namespace

std::vector<GridMap> find_grids(const std::vector<RadioEnd>& receivers) {
  std::vector<GridMap> out;
  for (uint32_t i = 0; i < receivers.size();) {
    const GridMap grid = grid_from(receivers, i);
    if (grid.count() > 0) out.push_back(grid);
    i += std::max(grid.count(), 1u);
  }
  return out;
}

nlohmann::json add_grid_blocks(const std::vector<GridMap>& grids, const std::vector<RadioEnd>& receivers,
                               const std::vector<glm::dvec3>& position_m, const glm::dvec3& centre_m,
                               std::string& elements) {
  nlohmann::json out = nlohmann::json::array();
  for (const GridMap& grid : grids) {
    Packer heights;
    for (uint32_t k = 0; k < grid.count(); ++k)
      heights.add(static_cast<float>(position_m[grid.first + k].z - centre_m.z));
    elements += block_element("grid_" + std::to_string(out.size()), heights);
    const glm::dvec3 first = position_m[grid.first] - centre_m,
                     last = position_m[grid.first + grid.count() - 1] - centre_m;
    const double step_x = grid.columns > 1 ? (last.x - first.x) / (grid.columns - 1) : 0,
                 step_y = grid.rows > 1 ? (last.y - first.y) / (grid.rows - 1) : step_x;
    const RadioEnd& cell = receivers[grid.first];
    out.push_back({{"name", grid.name},
                   {"first", grid.first},
                   {"columns", grid.columns},
                   {"rows", grid.rows},
                   {"first_m", {first.x, first.y}},
                   {"step_m", {step_x != 0 ? step_x : step_y, step_y}},
                   {"antenna", cell.antenna},
                   {"polarization", cell.polarization.word()}});
  }
  return out;
}

std::vector<bool> outside_of_grids(const std::vector<GridMap>& grids, size_t receivers) {
  std::vector<bool> out(receivers, true);
  for (const GridMap& grid : grids)
    for (uint32_t k = 0; k < grid.count(); ++k) out[grid.first + k] = false;
  return out;
}

}  // namespace wavetracer
