// A mesh in which flat regions are searched, and such a region: what all steps of the search share (flat_regions.hpp).
#pragma once
#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/plane_fit.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Cosine of 10 degrees: triangles and regions of one plane turn by less, but for slivers between them.
constexpr double least_cosine = 0.985;

struct FlatRegion {
  std::vector<uint32_t> triangles, vertices;  // each once
  Plane plane;                                // that of its largest triangle if it is exact, else the fitted one
  bool exact = true;                          // flat as it is: its vertices need not move
};

// A welded mesh with its edges.
struct FlatMesh {
  const Scene& scene;
  std::span<const std::array<uint32_t, 3>> triangle_edges;
  std::span<const double> tolerance_m;  // per vertex

  // Are all of these vertices within their tolerances, times a factor, of the plane?
  bool are_near(std::span<const uint32_t> vertices, const Plane& plane, double factor = 1) const;
  // The sums from which the plane of these vertices, at least one, is fitted.
  PlaneSums sums(std::span<const uint32_t> vertices) const;
  // The mean of these vertices, at least one.
  glm::dvec3 centre(std::span<const uint32_t> vertices) const;
  // The region of each triangle; all triangles are in one.
  std::vector<uint32_t> region_of_triangle(std::span<const FlatRegion> regions) const;
};

}  // namespace wavetracer
