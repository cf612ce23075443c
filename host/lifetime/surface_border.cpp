// SPDX-License-Identifier: Apache-2.0
#include "lifetime/surface_border.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

namespace wavetracer {

namespace {

// The triangles at a side lie to the left of it, seen from the tip of the normal, or to the right, or to both sides.
struct Side {
  bool left = false, right = false;
};
using Sides = std::map<std::pair<uint32_t, uint32_t>, Side>;  // by their two vertices, the lower index first

Sides sides_of(const Scene& scene, const Surface& surface) {
  Sides out;
  for (uint32_t k = 0; k < surface.triangle_count; ++k) {
    const auto& triangle = scene.triangles[scene.surface_triangles[surface.first_triangle + k]];
    for (int corner = 0; corner < 3; ++corner) {
      const std::pair<uint32_t, uint32_t> ends = std::minmax(triangle[corner], triangle[(corner + 1) % 3]);
      const glm::dvec3 &a = scene.vertices[ends.first], &b = scene.vertices[ends.second];
      const glm::dvec3& third = scene.vertices[triangle[(corner + 2) % 3]];
      const bool left = glm::dot(surface.normal, glm::cross(b - a, third - a)) > 0;
      (left ? out[ends].left : out[ends].right) = true;
    }
  }
  return out;
}

}  // namespace

SurfaceBorders::SurfaceBorders(const Scene& scene) {
  for (const Surface& surface : scene.surfaces) {
    first_.push_back(sides_.size());
    for (const auto& [ends, side] : sides_of(scene, surface))
      if (!(side.left && side.right)) sides_.push_back({scene.vertices[ends.first], scene.vertices[ends.second]});
  }
  first_.push_back(sides_.size());
}

double SurfaceBorders::margin_m(uint32_t surface, const glm::dvec3& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (uint64_t k = first_[surface]; k < first_[surface + 1]; ++k) least = std::min(least, distance_m(p, sides_[k]));
  return least;
}

}  // namespace wavetracer
