// Triangles that scatter and lie on others that do: of what several of one plane cover, each place is that of the
// first.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

class EarlierFaces {
 public:
  // Keeps a reference to the scene, whose surfaces are known. Triangles that only touch do not count.
  explicit EarlierFaces(const Scene& scene);

  // Is a point of this triangle on an earlier triangle of its plane?
  bool hold(uint32_t triangle, const glm::dvec3& point) const;
  // Triangles that lie on earlier ones, at least in part.
  uint64_t count() const;

 private:
  const Scene& scene_;
  std::vector<std::vector<uint32_t>> below_;  // of each triangle: the earlier ones
};

}  // namespace wavetracer
