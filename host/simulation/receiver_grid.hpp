// [[receiver_grid]] as receivers: one at the middle of each square cell, called NAME/IX,IY, row by row with IX first.
// Receivers inside of buildings stay, so that a grid is whole; no path leads to them.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "simulation/place_finder.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

constexpr uint64_t max_grid_receivers = 1'000'000;  // of all grids together

// Receiver (ix, iy) stands at x_m + ix * step_m, y_m + iy * step_m, in file coordinates.
struct GridShape {
  uint32_t columns = 1, rows = 1;
  double x_m = 0, y_m = 0, step_m = 1;
};

// As many cells as fit between the borders, in their middle, one at least. Throws ConfigError for borders that are
// exchanged, for more than max_grid_receivers, and for corners in degrees of a scene without a georeference.
GridShape grid_shape(const ReceiverGridConfig& grid, const Scene& scene, PlaceFinder& places);

// All transmitters that stand: [[transmitter]], then [[station]]; their position_m is set, however it was given.
std::vector<RadioEnd> standing_transmitters(const Config& config, PlaceFinder& places);

// All receivers that stand: [[receiver]], then [[station]], then the cells of grids, in their order. Only the scene's
// origin and extent are used, and its triangles where above = "ground". Throws ConfigError, also for a name that is
// taken.
std::vector<RadioEnd> standing_receivers(const Config& config, const Scene& scene, PlaceFinder& places);

struct GridCell {
  uint32_t ix = 0, iy = 0;
};

// The cell of a receiver by its name; empty if it does not belong to the grid.
std::optional<GridCell> grid_cell(const std::string& grid, const std::string& receiver);

}  // namespace wavetracer
