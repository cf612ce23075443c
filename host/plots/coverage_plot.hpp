// SPDX-License-Identifier: Apache-2.0
// Plots coverage: the path gain at every receiver of a grid in one frame, as an image over the walls of the scene.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>
#include "plots/figure.hpp"
#include "results/saved_run.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer::plots {

// The reception at one receiver of a grid.
struct CoverageCell {
  uint32_t ix = 0, iy = 0;
  glm::dvec3 position_m{0};  // file coordinates
  // Gain of the best transmitter, with the powers of its groups of paths added; NaN without a path.
  double path_gain_db = 0;
  std::optional<uint32_t> tx;  // that transmitter
  uint32_t paths = 0;          // for all transmitters that count
};

// Returns one entry per receiver, row by row. tx: if given, only this transmitter counts. Empty if the run has no
// receiver of that grid. Throws InputError if cells are missing.
std::vector<CoverageCell> coverage_cells(const SavedRun& run, const SavedFrame& frame, const std::string& grid,
                                         std::optional<uint32_t> tx);

// Returns the lines in which triangles of the scene cross the plane z = height_m: segments x0, y0, x1, y1, in file
// coordinates.
std::vector<std::array<double, 4>> section(const Scene& scene, double height_m);
// Returns them as CSV: x0_m,y0_m,x1_m,y1_m.
std::string wall_table(const std::vector<std::array<double, 4>>& walls);

// name: of the figure's files. At least one cell must have a path. radio: received powers are drawn if it defines them.
Figure coverage_figure(const SavedRun& run, const SavedFrame& frame, const std::string& name, const std::string& grid,
                       const std::vector<CoverageCell>& cells, std::optional<uint32_t> tx, const Scene& scene,
                       const RadioConfig& radio);

}  // namespace wavetracer::plots
