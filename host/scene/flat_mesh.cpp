// SPDX-License-Identifier: Apache-2.0
// Sums are taken over the vertices in their order, which decides their last bits.
#include "scene/flat_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace wavetracer {

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

}  // namespace wavetracer
