// SPDX-License-Identifier: Apache-2.0
// Receivers that form a grid, as [[receiver_grid]] makes it: the page draws them as a map and not one by one. They are
// recognised by their names, NAME/IX,IY row by row, so that a run can be read without its configuration.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>
#include "results/saved_run.hpp"

namespace wavetracer {

struct GridMap {
  std::string name;
  uint32_t first = 0, columns = 0, rows = 0;  // cell (ix, iy) is receiver first + iy * columns + ix
  uint32_t count() const { return columns * rows; }
};

// Returns grids in the order of their receivers, of at least 2 x 2 cells, or 4 in a row.
std::vector<GridMap> find_grids(const std::vector<RadioEnd>& receivers);

// The steps of columns and rows in x and y, and that of rows in z if the grid stands on a vertical plane, else 0. Cells
// of a single row or column are squares.
struct GridSteps {
  glm::dvec2 column_m{0}, row_m{0};
  double rise_m = 0;
};

// position_m: of all receivers of the run.
GridSteps steps_of(const GridMap& grid, const std::vector<glm::dvec3>& position_m);

// Appends an element block_grid_K of heights for each grid, and returns the other data that the page needs about them.
// position_m: of all receivers of the run. Cells must lie in equal steps along x and y, or along a line and upwards,
// and never move. The data have the steps of columns and of rows in x and y, and `rise_m`, that of rows in z on a
// vertical plane, else 0.
nlohmann::json add_grid_blocks(const std::vector<GridMap>& grids, const std::vector<RadioEnd>& receivers,
                               const std::vector<glm::dvec3>& position_m, const glm::dvec3& centre_m,
                               std::string& elements);

// Tells for each receiver whether it is on its own, and not a cell of a grid.
std::vector<bool> outside_of_grids(const std::vector<GridMap>& grids, size_t receivers);

}  // namespace wavetracer
