// SPDX-License-Identifier: Apache-2.0
// The coherent power over the area of a cell, which receivers at points do not show: every path is a plane wave around
// the middle of the cell, so that fields there follow from the phases of its paths and the directions they come from.
#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>
#include "coverage/coverage_map.hpp"

namespace wavetracer::coverage {

// A plane wave: its field at the middle of a cell for each pair of ports, and the steps of its phase along the sides.
struct PlaneWave {
  std::array<std::complex<double>, 4> field;
  glm::dvec2 phase_rad_m{0};
  double power = 0;  // sum of |field|^2
};

// The mean of the power over a cell, and its variance, as the square of a power.
struct AreaPower {
  double mean = 0, variance = 0;
};

// Only so many waves interfere, the strongest ones; of others the powers are added to the mean.
inline constexpr size_t most_interfering_waves = 1000;

// Returns the powers of the waves' sum over a rectangle; powers of pairs of ports are added. The mean is exact. The
// variance is that of 1,024 points, a set of Hammersley. Takes n^2 / 2 + 1,024 n steps for n waves that interfere.
AreaPower area_power(std::vector<PlaneWave> waves, const glm::dvec2& side_m);

// The sides of a cell: unit vectors to the next column and to the next row, and their lengths.
struct CellSides {
  std::array<glm::dvec3, 2> direction{{{1, 0, 0}, {0, 1, 0}}};
  glm::dvec2 length_m{0};
};

// The values of Cell of these names; NaN without power.
struct AreaLevels {
  double cell_mean_db = Cell::none, fading_db = Cell::none;
};

// Returns the levels of the paths in these rows, which are all of one link.
AreaLevels area_levels(const Paths& paths, std::span<const size_t> rows, double frequency_hz, const CellSides& sides);

// Sets cell_mean_db and fading_db of the map's cells, which have their servers. paths: those of the frame. cell_of:
// cell of each receiver of the run, or one that the map does not have. server_of: transmitter of each cell.
void add_areas(const Paths& paths, double frequency_hz, std::span<const uint32_t> cell_of,
               std::span<const uint32_t> server_of, Map& map);

}  // namespace wavetracer::coverage
