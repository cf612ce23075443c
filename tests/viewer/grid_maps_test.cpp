// SPDX-License-Identifier: Apache-2.0
// The steps of grids in the data of the page, by hand.
#include "viewer/grid_maps.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <string>
#include <vector>

using namespace wavetracer;

TEST_CASE("a row of cells has squares along it, whatever its direction") {
  std::vector<RadioEnd> cells;
  std::vector<glm::dvec3> slanting, rising;
  for (int k = 0; k < 4; ++k) {
    cells.push_back({.name = fmt::format("g/{},0", k)});
    slanting.push_back({3.0 * k, 4.0 * k, 2});
    rising.push_back({1, 2, 5.0 * k});
  }
  std::string elements;
  nlohmann::json grid = add_grid_blocks(find_grids(cells), cells, slanting, {0, 0, 0}, elements)[0];
  CHECK(grid["column_m"] == nlohmann::json{3, 4});
  CHECK(grid["row_m"] == nlohmann::json{-4, 3});
  CHECK(grid["rise_m"] == 0);
  for (int k = 0; k < 4; ++k) cells[k].name = fmt::format("g/0,{}", k);
  grid = add_grid_blocks(find_grids(cells), cells, rising, {0, 0, 0}, elements)[0];
  CHECK(grid["column_m"] == nlohmann::json{5, 0});
  CHECK(grid["row_m"] == nlohmann::json{0, 0});
  CHECK(grid["rise_m"] == 5);
}
