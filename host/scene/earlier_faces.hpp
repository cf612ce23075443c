// SPDX-License-Identifier: Apache-2.0
// Finds triangles that scatter and lie on other triangles that scatter. Where several triangles of one plane overlap,
// only the first of them scatters.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

class EarlierFaces {
 public:
  // Keeps a reference to the scene, whose surfaces must be known. Triangles that only touch do not count.
  explicit EarlierFaces(const Scene& scene);

  // Tells whether a point of this triangle lies on an earlier triangle of its plane.
  bool hold(uint32_t triangle, const glm::dvec3& point) const;
  // Returns the number of triangles that lie on earlier ones, at least in part.
  uint64_t count() const;

 private:
  const Scene& scene_;
  std::vector<std::vector<uint32_t>> below_;  // for each triangle, the earlier triangles that it lies on
};

}  // namespace wavetracer
