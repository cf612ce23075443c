// SPDX-License-Identifier: Apache-2.0
// Finds triangles that continue one another, over edges of the mesh or where free edges run along each other.
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Two triangles that meet at one edge, or at two free edges that overlap.
struct FlatNeighbour {
  uint32_t triangle, other;
  uint32_t edge, other_edge;  // into Scene::edges
};

class FlatNeighbours {
 public:
  FlatNeighbours(const Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges);

  template <class Visit>
  void visit(uint32_t t, const Visit& visit) const {
    for (const uint32_t e : triangle_edges_[t]) {
      const Edge& edge = scene_.edges[e];
      for (uint32_t i = 0; i < edge.face_count; ++i) {
        const uint32_t other = scene_.edge_faces[edge.first_face + i];
        if (other != t) visit(FlatNeighbour{t, other, e, e});
      }
    }
    for (uint32_t i = first_touching(t); i < touching_.size() && touching_[i].triangle == t; ++i) visit(touching_[i]);
  }

  // Visits the three edges of a triangle and tells for each whether it is free.
  template <class Visit>
  void visit_edges(uint32_t t, const Visit& visit) const {
    for (const uint32_t e : triangle_edges_[t]) visit(e, scene_.edges[e].face_count == 1);
  }

  // Tells whether the other triangle continues beyond the edge, seen along the normal, instead of folding back.
  bool unfolded(const FlatNeighbour& pair, const glm::dvec3& normal) const;
  double length_m(uint32_t edge) const;

 private:
  uint32_t first_touching(uint32_t t) const;

  const Scene& scene_;
  std::span<const std::array<uint32_t, 3>> triangle_edges_;
  std::vector<FlatNeighbour> touching_;  // pairs over free edges, in both directions, sorted by triangle
};

}  // namespace wavetracer
