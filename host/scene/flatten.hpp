// Puts vertices onto the planes that they were on before their coordinates were rounded or measured: a wall is a wall.
// Assumes a welded mesh with its edges; surfaces are found afterwards (host/scene/topology.hpp).
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
  std::vector<glm::dvec3> vertices;  // as many as before
  std::vector<Plane> planes;
  std::vector<uint32_t> triangle_plane;  // per triangle: into planes, or no_plane; its corners were moved into it
  std::vector<uint32_t> exact_plane;     // per triangle: into planes, or no_plane; it lies within 0.1 mm of it as it is
  uint64_t moved = 0;                    // vertices
  double farthest_m = 0;                 // that one of them was moved
  uint64_t left_out = 0;                 // triangles of planes that a corner could not be put onto
};

// Finds the planes (host/scene/flat_regions.hpp) and moves vertices onto them, by the shortest way: one of a single
// plane is projected, one of two goes to their line, one of three to their point. Planes that meet at a small angle are
// fitted together, so that their line is near the vertices on it. No vertex moves farther than its tolerance: where it
// would, the smallest of its planes loses the triangles at it. Vertices of planes that are exact stay in them, and what
// is exact all around is not moved at all. The result does not depend on the order of triangles and vertices.
Flattened flatten(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges,
                  std::span<const double> tolerance_m);

}  // namespace wavetracer
