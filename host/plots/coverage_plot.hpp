// SPDX-License-Identifier: Apache-2.0
// Plots coverage: a layer of the map of a grid in one frame, as an image over the walls of the scene.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>
#include "coverage/coverage_map.hpp"
#include "plots/figure.hpp"
#include "results/saved_run.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer::plots {

// Returns the layer that is drawn: the one of that name, or, if it is empty, received power if the run has a link
// budget, else path gain. Throws ConfigError for a name that is no layer.
const coverage::LayerKind& shown_layer(const std::string& name, const RadioConfig& radio);

// Returns the lines in which triangles of the scene cross the plane z = height_m: segments x0, y0, x1, y1, in file
// coordinates.
std::vector<std::array<double, 4>> section(const Scene& scene, double height_m);
// Returns those in which they cross the vertical plane: distance along it and z of both ends.
std::vector<std::array<double, 4>> section(const Scene& scene, const coverage::VerticalPlane& plane);
// Returns them as CSV: x0_m,y0_m,x1_m,y1_m, or along0_m,z0_m,along1_m,z1_m if the plane is upright.
std::string wall_table(const std::vector<std::array<double, 4>>& walls, bool upright = false);

// name: of the figure's files. layer: one of the map's, which must have a value in some cell. Weak is dark and strong
// is bright; cells without a value are grey.
Figure coverage_figure(const SavedRun& run, const SavedFrame& frame, const std::string& name, const coverage::Map& map,
                       const coverage::LayerKind& layer, const Scene& scene, const RadioConfig& radio);

}  // namespace wavetracer::plots
