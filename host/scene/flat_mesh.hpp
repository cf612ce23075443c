// SPDX-License-Identifier: Apache-2.0
// A mesh in which flat regions are searched, and such a region; all steps of the search use them (flat_regions.hpp).
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

}  // namespace wavetracer
