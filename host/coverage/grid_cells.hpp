// SPDX-License-Identifier: Apache-2.0
// Finds the cells of a grid among the receivers of a run or of a configuration, and the place of a map by them.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <string>
#include <vector>
#include "coverage/coverage_map.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::coverage {

inline constexpr uint32_t no_cell = std::numeric_limits<uint32_t>::max();

struct Receivers {
  std::span<const RadioEnd> ends;
  std::span<const glm::dvec3> position_m;  // one for each end, in file coordinates
  std::string source;                      // the file that has them, for errors
};

// Returns the cell of each receiver, or no_cell, and sets the shape of the map and the heights of its cells. A grid
// does not move, so its receivers must be at their places. Throws InputError if cells are missing, or there twice.
std::vector<uint32_t> place_cells(const Receivers& receivers, const ReceiverGridConfig& grid, Map& map);

}  // namespace wavetracer::coverage
