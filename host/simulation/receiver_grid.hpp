// SPDX-License-Identifier: Apache-2.0
// Makes receivers of [[receiver_grid]]: one at the middle of each square cell, called NAME/IX,IY, row by row with IX
// first. Receivers inside of buildings stay, so that a grid is complete; no path leads to them.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "simulation/place_finder.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

constexpr uint64_t max_grid_receivers = 1'000'000;  // for all grids together

// Receiver (ix, iy) is at x_m + ix * step_m, y_m + iy * step_m, in file coordinates.
struct GridShape {
  uint32_t columns = 1, rows = 1;
  double x_m = 0, y_m = 0, step_m = 1;
};

// Fits as many cells as possible between the borders, in their middle, at least one. Throws ConfigError for borders
// that are exchanged, for more than max_grid_receivers, and for corners in degrees in a scene without a georeference.
GridShape grid_shape(const ReceiverGridConfig& grid, const Scene& scene, PlaceFinder& places);

// All fixed transmitters: [[transmitter]], then [[station]]; their position_m is set, in whichever way it was given.
std::vector<RadioEnd> standing_transmitters(const Config& config, PlaceFinder& places);

// All fixed receivers: [[receiver]], then [[station]], then the cells of grids, in their order. This only uses the
// scene's origin and extent, and its triangles if above = "ground". Throws ConfigError, also for a name that is taken.
std::vector<RadioEnd> standing_receivers(const Config& config, const Scene& scene, PlaceFinder& places);

struct GridCell {
  uint32_t ix = 0, iy = 0;
};

// Returns the cell of a receiver by its name; empty if it does not belong to the grid.
std::optional<GridCell> grid_cell(const std::string& grid, const std::string& receiver);

}  // namespace wavetracer
