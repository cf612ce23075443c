// SPDX-License-Identifier: Apache-2.0
// Cells are known by their names, so that a run can be read without the places where its grids would be made.
#include "coverage/grid_cells.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>
#include "simulation/receiver_grid.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::coverage {
namespace {

// Sets the place and the steps of a map by its first and last cell.
void set_shape(const glm::dvec3& first, const glm::dvec3& last, const ReceiverGridConfig& grid, Map& map) {
  glm::dvec2 way = glm::dvec2(last) - glm::dvec2(first);
  map.first_m = first;
  if (grid.vertical()) {
    VerticalPlane& plane = map.plane.emplace();
    plane.from_m = {grid.from_m->at(0), grid.from_m->at(1)};
    plane.to_m = {grid.to_m->at(0), grid.to_m->at(1)};
    plane.direction = plane_direction(grid);
    plane.first_along_m = plane.along_and_off_m(first.x, first.y).x;
    plane.first_z_m = first.z;
    way = {glm::length(way), last.z - first.z};
  }
  map.step_m = {map.columns > 1 ? way.x / (map.columns - 1) : grid.step_m,
                map.rows > 1 ? way.y / (map.rows - 1) : grid.step_m};
}

}  // namespace

std::vector<uint32_t> place_cells(const Receivers& receivers, const ReceiverGridConfig& grid, Map& map) {
  std::vector<uint32_t> cell_of(receivers.ends.size(), no_cell);
  std::vector<std::pair<GridCell, uint32_t>> found;
  for (uint32_t rx = 0; rx < receivers.ends.size(); ++rx)
    if (const auto place = grid_cell(grid.name, receivers.ends[rx].name)) found.emplace_back(*place, rx);
  for (const auto& [place, rx] : found) {
    map.columns = std::max(map.columns, place.ix + 1);
    map.rows = std::max(map.rows, place.iy + 1);
  }
  std::vector<uint32_t> receiver(found.size(), no_cell);
  bool whole = !found.empty() && uint64_t{map.columns} * map.rows == found.size();
  for (size_t k = 0; whole && k < found.size(); ++k) {
    const auto& [place, rx] = found[k];
    whole = place.ix < map.columns && place.iy < map.rows;  // the largest numbers have no number of columns
    if (!whole) break;
    uint32_t& here = receiver[size_t{place.iy} * map.columns + place.ix];
    whole = here == no_cell;
    here = rx;
  }
  if (!whole)
    throw InputError(
        fmt::format("{}: receivers of the grid \"{}\" are missing, or there twice", receivers.source, grid.name));
  for (uint32_t k = 0; k < receiver.size(); ++k) {
    cell_of[receiver[k]] = k;
    map.z_m.push_back(receivers.position_m[receiver[k]].z);
  }
  set_shape(receivers.position_m[receiver.front()], receivers.position_m[receiver.back()], grid, map);
  return cell_of;
}

}  // namespace wavetracer::coverage
