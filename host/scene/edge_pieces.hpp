// SPDX-License-Identifier: Apache-2.0
// Cuts edges of the mesh where they touch or cross others, so that meshes that are not welded along an edge share its
// pieces. It needs Scene::edges with Edge::flat; flat edges have no pieces.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/scene_grid.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Points nearer to each other than this are one place for edges and their faces: welding moves vertices up to that far.
constexpr double touch_m = 2e-3;
// Faces whose angles about an edge differ by less than this are one wall, with nothing between them.
constexpr double same_angle_rad = 1e-3;

// A piece of an edge between two joints, which are places where edges that are not flat end, touch or cross. The faces
// at it are the same along the whole piece.
struct EdgePiece {
  std::array<uint32_t, 2> joints;  // numbers of the joints, the lower one first
  glm::dvec3 start{0}, end{0};     // positions of the joints on the longest mesh edge that runs along the piece
  glm::dvec3 along{0};             // unit vector of that edge, from start to end
  uint32_t first_edge = 0, edge_count = 0;  // into EdgePieces::edges
};

struct EdgePieces {
  std::vector<EdgePiece> pieces;  // each once, sorted by joints
  std::vector<uint32_t> edges;    // the mesh edges that run along each piece
};

EdgePieces split_edges(const Scene& scene, const SceneGrid& grid);

}  // namespace wavetracer
