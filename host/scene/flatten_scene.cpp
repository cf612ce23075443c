// SPDX-License-Identifier: Apache-2.0
// Computes tolerances of vertices and writes messages for the user.
#include "scene/flatten_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace wavetracer {

Flattened flatten_scene(Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges, double tolerance_m,
                        std::span<const double> rounding_m) {
  std::vector<double> tolerances_m;
  for (const double rounding : rounding_m)
    tolerances_m.push_back(tolerance_m > 0 ? std::max(tolerance_m, 2 * rounding) : 0);
  Flattened flat = flatten(scene, triangle_edges, tolerances_m);
  scene.vertices = std::move(flat.vertices);
  LoadReport& report = scene.report;
  report.plane_tolerance_m = *std::max_element(tolerances_m.begin(), tolerances_m.end());
  report.flattened_vertices = flat.moved;
  report.flattened_by_m = flat.farthest_m;
  report.bent_triangles = flat.left_out;
  if (flat.farthest_m > tolerance_m)
    report.warnings.push_back(fmt::format(
        "the coordinates of the scene are as coarse as {:.2g} mm, so {} vertices were moved by up to {:.2g} mm "
        "onto the planes of their surfaces: save the scene nearer to its origin, or with double coordinates",
        report.plane_tolerance_m * 1000, flat.moved, flat.farthest_m * 1000));
  return flat;
}

}  // namespace wavetracer
