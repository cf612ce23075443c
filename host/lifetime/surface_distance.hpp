// SPDX-License-Identifier: Apache-2.0
// Distances from lines to the triangles of one scene or model, in its own coordinates, in double.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

#include "accel/build.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// A straight line from a to b.
struct Segment {
  glm::dvec3 a, b;
};

// Returns the smallest distance between points of the two; 0 where they meet.
double distance_m(const Segment& segment, const std::array<glm::dvec3, 3>& triangle);
double distance_m(const Segment& segment, const Segment& other);
double distance_m(const glm::dvec3& p, const Segment& segment);

class SurfaceDistance {
 public:
  // It keeps a reference to the scene.
  explicit SurfaceDistance(const Scene& scene);

  // Returns the distance from the segment to the nearest triangle whose surface is not left out, but no more than
  // most_m. leaves_out: is asked with indices into Scene::surfaces.
  double operator()(const Segment& segment, double most_m, const std::function<bool(uint32_t)>& leaves_out) const;

 private:
  std::array<glm::dvec3, 3> corners(uint32_t triangle) const;

  const Scene& scene_;
  BinaryTree tree_;  // over all triangles; without nodes where there are none
};

}  // namespace wavetracer
