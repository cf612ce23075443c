// SPDX-License-Identifier: Apache-2.0
// Converts the scene's doubles to float32 triangles.
// The loader must have dropped zero-area triangles and checked indices.
#include "accel/triangles.hpp"

#include <cmath>
#include <string>

#include "wavetracer/error.hpp"

namespace wavetracer {

std::vector<AccelTriangle> accel_triangles(const Scene& scene) {
  std::vector<AccelTriangle> triangles(scene.triangles.size());
  for (size_t i = 0; i < triangles.size(); i++) {
    AccelTriangle& triangle = triangles[i];
    for (size_t vertex = 0; vertex < 3; vertex++) {
      const glm::dvec3& position = scene.vertices[scene.triangles[i][vertex]];
      for (int axis = 0; axis < 3; axis++) {
        const float coordinate = static_cast<float>(position[axis]) + 0.0f;
        if (!std::isfinite(coordinate)) {
          throw InputError(scene.file + ": triangle " + std::to_string(i) + " has the coordinate " +
                           std::to_string(position[axis]) +
                           " m, which single precision cannot hold; check the scene's units");
        }
        triangle.v[vertex][axis] = coordinate;
      }
    }
    triangle.primitive = static_cast<uint32_t>(i);
    triangle.surface = scene.triangle_surface[i];
  }
  return triangles;
}

}  // namespace wavetracer
