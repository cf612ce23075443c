// SPDX-License-Identifier: Apache-2.0
// Sums are taken over the vertices in their order, which decides their last bits. Free edges are cut where they touch,
// as for diffraction (edge_pieces.hpp); two of them that share a piece overlap.
#include "scene/flat_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/edge_pieces.hpp"
#include "scene/topology.hpp"

namespace wavetracer {
namespace {

// Returns a scene with the free edges alone, so that the pieces are those of T-junctions.
Scene free_edges_of(const Scene& scene, std::vector<SceneBox>& boxes) {
  Scene out;
  out.vertices = scene.vertices;
  for (const Edge& edge : scene.edges) {
    Edge copy = edge;
    copy.flat = edge.face_count != 1;
    out.edges.push_back(copy);
    if (copy.flat) continue;
    const glm::dvec3 &a = scene.vertices[edge.vertices[0]], &b = scene.vertices[edge.vertices[1]];
    boxes.push_back({glm::min(a, b) - touch_m, glm::max(a, b) + touch_m});
  }
  return out;
}

}  // namespace

bool FlatMesh::are_near(std::span<const uint32_t> vertices, const Plane& plane, double factor) const {
  return std::ranges::all_of(
      vertices, [&](uint32_t v) { return std::abs(height_over(plane, scene.vertices[v])) <= factor * tolerance_m[v]; });
}

PlaneSums FlatMesh::sums(std::span<const uint32_t> vertices) const {
  PlaneSums out(scene.vertices[vertices.front()]);
  for (const uint32_t v : vertices) out.add(scene.vertices[v]);
  return out;
}

glm::dvec3 FlatMesh::centre(std::span<const uint32_t> vertices) const {
  glm::dvec3 sum(0);
  for (const uint32_t v : vertices) sum += scene.vertices[v];
  return sum / static_cast<double>(vertices.size());
}

std::vector<uint32_t> FlatMesh::region_of_triangle(std::span<const FlatRegion> regions) const {
  std::vector<uint32_t> out(scene.triangles.size());
  for (uint32_t r = 0; r < regions.size(); ++r)
    for (const uint32_t t : regions[r].triangles) out[t] = r;
  return out;
}

FlatNeighbours::FlatNeighbours(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges)
    : scene_(scene), triangle_edges_(triangle_edges) {
  std::vector<SceneBox> boxes;
  const Scene free = free_edges_of(scene, boxes);
  if (boxes.size() < 2) return;
  const EdgePieces pieces = split_edges(free, SceneGrid(boxes));
  for (const EdgePiece& piece : pieces.pieces) {
    for (uint32_t i = 0; i < piece.edge_count; ++i) {
      for (uint32_t k = 0; k < piece.edge_count; ++k) {
        const uint32_t a = pieces.edges[piece.first_edge + i], b = pieces.edges[piece.first_edge + k];
        if (a == b) continue;
        touching_.push_back(
            {scene.edge_faces[scene.edges[a].first_face], scene.edge_faces[scene.edges[b].first_face], a, b});
      }
    }
  }
  const auto key = [](const FlatNeighbour& n) { return std::array{n.triangle, n.other, n.edge, n.other_edge}; };
  std::ranges::sort(touching_, {}, key);
  touching_.erase(std::ranges::unique(touching_, {}, key).begin(), touching_.end());
}

uint32_t FlatNeighbours::first_touching(uint32_t t) const {
  if (touching_.empty()) return 0;
  return static_cast<uint32_t>(std::ranges::lower_bound(touching_, t, {}, &FlatNeighbour::triangle) -
                               touching_.begin());
}

bool FlatNeighbours::unfolded(const FlatNeighbour& pair, const glm::dvec3& normal) const {
  const Edge& edge = scene_.edges[pair.edge];
  const glm::dvec3 &a = scene_.vertices[edge.vertices[0]], &b = scene_.vertices[edge.vertices[1]];
  const glm::dvec3 side = glm::cross(normal, b - a);
  const auto across = [&](uint32_t t, uint32_t e) {
    return glm::dot(side, scene_.vertices[apex(scene_, t, scene_.edges[e])] - a);
  };
  const double own = across(pair.triangle, pair.edge), others = across(pair.other, pair.other_edge);
  return (own > 0 && others < 0) || (own < 0 && others > 0);
}

double FlatNeighbours::length_m(uint32_t edge) const {
  const auto& [a, b] = scene_.edges[edge].vertices;
  return glm::distance(scene_.vertices[a], scene_.vertices[b]);
}

}  // namespace wavetracer
