// SPDX-License-Identifier: Apache-2.0
// A grid begins with a cell 0,0 and ends where the next name is not that of the next cell.
// If its last row is incomplete, it is no grid: its receivers are then ordinary ends.
#include "viewer/grid_maps.hpp"
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
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

// Cells of a single row or column are squares: they lie, or stand along x if it is a column that goes up.
GridSteps steps_of(const GridMap& grid, const std::vector<glm::dvec3>& position_m) {
  constexpr double upright = 1e-6;  // largest part of a step in x and y of rows that go up
  const glm::dvec3& first = position_m[grid.first];
  GridSteps out;
  if (grid.columns > 1)
    out.column_m = glm::dvec2(position_m[grid.first + grid.columns - 1] - first) / (grid.columns - 1.0);
  if (grid.rows > 1) {
    const glm::dvec3 step = (position_m[grid.first + grid.columns * (grid.rows - 1)] - first) / (grid.rows - 1.0);
    if (glm::length(glm::dvec2(step)) <= upright * std::abs(step.z))
      out.rise_m = step.z;
    else
      out.row_m = step;
  }
  if (grid.rows == 1) out.row_m = {-out.column_m.y, out.column_m.x};
  if (grid.columns == 1)
    out.column_m = out.rise_m != 0 ? glm::dvec2(out.rise_m, 0) : glm::dvec2(out.row_m.y, -out.row_m.x);
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
    const glm::dvec3 first = position_m[grid.first] - centre_m;
    const GridSteps steps = steps_of(grid, position_m);
    const RadioEnd& cell = receivers[grid.first];
    out.push_back({{"name", grid.name},
                   {"first", grid.first},
                   {"columns", grid.columns},
                   {"rows", grid.rows},
                   {"first_m", {first.x, first.y}},
                   {"column_m", {steps.column_m.x, steps.column_m.y}},
                   {"row_m", {steps.row_m.x, steps.row_m.y}},
                   {"rise_m", steps.rise_m},
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
