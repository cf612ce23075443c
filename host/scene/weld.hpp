// SPDX-License-Identifier: Apache-2.0
// Welding merges vertices of all meshes that are the same point of the world.
// Coordinates must be finite and below about 10^9 tolerances times 10^6 (whole cells must fit into 63 bits).
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Just under 1 mm, so that walls 1 mm apart stay separate. That is above the rounding of float32 files (0.06 mm at 1
// km, 0.5 mm at 8 km) and of modelling tools that snap to tenths of millimetres, and below any detail that matters to
// waves of centimetres (5.9 GHz: 51 mm).
constexpr double weld_tolerance_m = 9.5e-4;

struct Weld {
  std::vector<uint32_t> vertex;       // input vertex -> entry of positions
  std::vector<glm::dvec3> positions;  // position of each group's first vertex, in order of first vertices
  double widest_m = 0;                // largest distance between a vertex and its new position
};

// Vertices closer than the tolerance share a group, and so do vertices linked by a chain of such pairs: the groups do
// not depend on the order of the vertices. Each group takes the exact position of its lowest vertex.
Weld weld_vertices(std::span<const glm::dvec3> vertices, double tolerance_m);

// Removes vertices that no triangle uses, keeping the order of the others. Returns the former number of each that is
// left.
std::vector<uint32_t> drop_unused_vertices(Scene& scene);

}  // namespace wavetracer
