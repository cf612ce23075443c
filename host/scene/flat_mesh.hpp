// SPDX-License-Identifier: Apache-2.0
// A mesh in which flat regions are searched, such a region, and the triangles that continue one another; all steps of
// the search use them (flat_regions.hpp).
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/plane_fit.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Cosine of 10 degrees: triangles and regions of one plane turn by less, except for slivers between them.
constexpr double least_cosine = 0.985;

struct FlatRegion {
  std::vector<uint32_t> triangles, vertices;  // each of them once
  Plane plane;                                // the plane of its largest triangle if `exact`, else the fitted plane
  bool exact = true;                          // all vertices are in the plane already and need not move
};

// A welded mesh with its edges.
struct FlatMesh {
  const Scene& scene;
  std::span<const std::array<uint32_t, 3>> triangle_edges;
  std::span<const double> tolerance_m;  // per vertex, in metres

  // Tells whether all these vertices are within their tolerances, times a factor, of the plane.
  bool are_near(std::span<const uint32_t> vertices, const Plane& plane, double factor = 1) const;
  // Returns the sums from which the plane of these vertices is fitted; there must be at least one vertex.
  PlaneSums sums(std::span<const uint32_t> vertices) const;
  // Returns the mean of these vertices; there must be at least one.
  glm::dvec3 centre(std::span<const uint32_t> vertices) const;
  // Returns the region of each triangle; every triangle must be in one.
  std::vector<uint32_t> region_of_triangle(std::span<const FlatRegion> regions) const;
};

// Finds triangles that continue one another, over edges of the mesh or where free edges run along each other.

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
