// SPDX-License-Identifier: Apache-2.0
// Finds the outside of a closed mesh, even if the file has some triangles more than once.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/raw_scene.hpp"

namespace wavetracer {

struct ClosedFaces {
  std::vector<Triangle> triangles;     // empty if the mesh is not closed
  uint64_t repeated = 0;               // number of dropped triangles, which repeat the corners of an earlier one
  uint64_t edges = 0, open_edges = 0;  // open edges are not passed equally often in both directions
};

// Takes connected triangles over shared vertices. A mesh that has every triangle once is taken unchanged if every edge
// is passed equally often in both directions. If triangles are repeated, in either orientation, each counts once, and
// all are turned outwards; a wall between two closed parts (there twice as often as the others, or in both
// orientations) is dropped.
ClosedFaces closed_faces(std::span<const glm::dvec3> positions, const std::vector<Triangle>& triangles);

}  // namespace wavetracer
