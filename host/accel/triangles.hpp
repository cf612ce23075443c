// SPDX-License-Identifier: Apache-2.0
// Triangles in the form for acceleration structures: float32, recentred, with the indices that a hit reports.
// accel_triangles refuses coordinates that float32 cannot hold.
#pragma once
#include <cstdint>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

struct AccelTriangle {
  float v[3][3];       // [vertex][axis], metres
  uint32_t primitive;  // index into Scene::triangles
  uint32_t surface;    // index into Scene::surfaces
};

// Returns all triangles of a scene, in its order; each vertex is the nearest float32 of the recentred double, so
// triangles that share a vertex still share it exactly. Negative zeros become positive, which makes builds independent
// of the order of comparisons. Throws InputError for a coordinate that is not finite in float32.
std::vector<AccelTriangle> accel_triangles(const Scene& scene);

}  // namespace wavetracer
