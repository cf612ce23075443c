// The outside of a closed mesh, whichever of its triangles are in the file more than once.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/raw_scene.hpp"

namespace wavetracer {

struct ClosedFaces {
  std::vector<Triangle> triangles;     // none where the mesh is not closed
  uint64_t repeated = 0;               // triangles that were left out: their corners are those of an earlier one
  uint64_t edges = 0, open_edges = 0;  // open: not passed as often one way as the other
};

// Triangles that hang together, by vertices. A mesh with every triangle once is taken as it is where every edge is
// passed as often one way as the other. Of one that repeats some, in whatever sense, each counts once, and all are
// turned outwards; a wall between two closed parts (twice as often there as the others, or there both ways) is none.
ClosedFaces closed_faces(std::span<const glm::dvec3> positions, const std::vector<Triangle>& triangles);

}  // namespace wavetracer
