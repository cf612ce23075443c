// SPDX-License-Identifier: Apache-2.0
// The borders of surfaces: the sides of triangles beyond which no other triangle of the same surface
// begins.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "lifetime/surface_distance.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

class SurfaceBorders {
 public:
  explicit SurfaceBorders(const Scene& scene);

  // Returns how far a point of the surface is from its border, in metres, and the coordinates of the scene. It is too
  // small where triangles of a surface touch without sharing a side.
  double margin_m(uint32_t surface, const glm::dvec3& p) const;

 private:
  std::vector<Segment> sides_;
  std::vector<uint64_t> first_;  // first side of each surface
};

}  // namespace wavetracer
