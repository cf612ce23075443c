// Edges of the mesh cut where they touch or cross others, so that meshes which are not welded along share their pieces.
// Assumes Scene::edges with Edge::flat; flat edges have no pieces.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/scene_grid.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Points nearer to each other than this are one place for edges and their faces: welding moves vertices as far.
constexpr double touch_m = 2e-3;
// Faces whose angles about an edge differ by less than this are one wall: nothing is between them.
constexpr double same_angle_rad = 1e-3;

// A stretch between two joints: places where edges that are not flat end, touch or cross. Nothing about the faces at it
// changes along it.
struct EdgePiece {
  std::array<uint32_t, 2> joints;           // numbers of places, the lower one first
  glm::dvec3 start{0}, end{0};              // there, on the longest mesh edge that runs along it
  glm::dvec3 along{0};                      // unit, of that edge, from start to end
  uint32_t first_edge = 0, edge_count = 0;  // into EdgePieces::edges
};

struct EdgePieces {
  std::vector<EdgePiece> pieces;  // each once, sorted by joints
  std::vector<uint32_t> edges;    // mesh edges that run along a piece
};

EdgePieces split_edges(const Scene& scene, const SceneGrid& grid);

}  // namespace wavetracer
