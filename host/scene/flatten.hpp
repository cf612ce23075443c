// SPDX-License-Identifier: Apache-2.0
// Moves vertices onto the planes that they were on before their coordinates were rounded or measured. The mesh must be
// welded and have its edges; surfaces are found afterwards (host/scene/topology.hpp).
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/plane_fit.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

constexpr uint32_t no_plane = 0xFFFFFFFFu;

struct Flattened {
  std::vector<glm::dvec3> vertices;  // same number and order as before
  std::vector<Plane> planes;
  // Per triangle: index into planes, or no_plane; its corners were moved into that plane.
  std::vector<uint32_t> triangle_plane;
  // Per triangle: index into planes, or no_plane; it lies within 0.1 mm of that plane without moving.
  std::vector<uint32_t> exact_plane;
  uint64_t moved = 0;     // number of vertices that were moved
  double farthest_m = 0;  // the largest move
  uint64_t left_out = 0;  // triangles of planes that one of their corners could not be moved onto
};

// Finds the planes (host/scene/flat_regions.hpp) and moves vertices onto them by the shortest way: a vertex of one
// plane is projected onto it, one of two planes goes to their line, one of three to their point. Planes that meet at a
// small angle are fitted together, so that their line is near the vertices on it. No vertex moves farther than its
// tolerance: where it would have to, the smallest of its planes loses the triangles at it. Vertices of exact planes
// stay in them, and a vertex whose planes are all exact is not moved. The result does not depend on the order of
// triangles and vertices.
Flattened flatten(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges,
                  std::span<const double> tolerance_m);

// Moves the vertices of a scene within tolerance_m, or twice the rounding of a vertex where that is more, and notes in
// the report what was moved. Zero moves nothing at all.
Flattened flatten_scene(Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges, double tolerance_m,
                        std::span<const double> rounding_m);

}  // namespace wavetracer
