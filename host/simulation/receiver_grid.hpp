// SPDX-License-Identifier: Apache-2.0
// Makes receivers of [[receiver_grid]]: one at the middle of each square cell, called NAME/IX,IY, row by row with IX
// first. Receivers inside of buildings stay, so that a grid is complete; no path leads to them. A grid is horizontal,
// or it stands on a vertical plane, where rows go up.
#pragma once
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "simulation/place_finder.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

constexpr uint64_t max_grid_receivers = 20'000'000;  // for all grids together

// Receiver (0, 0) is at x_m, y_m, in file coordinates. A step of ix goes along `column_direction`, and one of iy along
// `row_direction`, both step_m long. z_m is that of row 0 of a vertical plane, and 0 for a horizontal grid.
struct GridShape {
  uint32_t columns = 1, rows = 1;
  double x_m = 0, y_m = 0, step_m = 1, z_m = 0;
  glm::dvec3 column_direction{1, 0, 0}, row_direction{0, 1, 0};

  uint64_t cells() const { return uint64_t{columns} * rows; }
  glm::dvec3 at(uint32_t ix, uint32_t iy) const {
    return glm::dvec3(x_m, y_m, z_m) + (ix * step_m) * column_direction + (iy * step_m) * row_direction;
  }
};

// Returns the unit vector from from_m to to_m of a vertical plane.
glm::dvec2 plane_direction(const ReceiverGridConfig& grid);

// Fits as many cells as possible between the borders, in their middle, at least one. Throws ConfigError for borders
// that are exchanged, for more than max_grid_receivers, and for corners in degrees in a scene without a georeference.
GridShape grid_shape(const ReceiverGridConfig& grid, const Scene& scene, PlaceFinder& places);

// All fixed transmitters: [[transmitter]], then [[station]]; their position_m is set, in whichever way it was given.
std::vector<RadioEnd> standing_transmitters(const Config& config, PlaceFinder& places);

// All fixed receivers: [[receiver]], then [[station]], then the cells of grids, in their order. This only uses the
// scene's origin and extent, and its triangles if above = "ground". Throws ConfigError, also for a name that is taken
// and for grids of several heights, which the reader of configurations makes grids of one.
std::vector<RadioEnd> standing_receivers(const Config& config, const Scene& scene, PlaceFinder& places);

struct GridCell {
  uint32_t ix = 0, iy = 0;
};

// Returns the cell of a receiver by its name; empty if it does not belong to the grid.
std::optional<GridCell> grid_cell(const std::string& grid, const std::string& receiver);

}  // namespace wavetracer
