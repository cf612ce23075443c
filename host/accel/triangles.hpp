// Triangles as the acceleration structures take them: float32, recentred, with the indices a hit reports.
// Assumes coordinates that float32 can hold; accel_triangles refuses others.
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

// All triangles of a scene, in its order; each vertex is the nearest float32 of the recentred double, so triangles that
// share a vertex still share it exactly. Negative zeros become positive: builds are then independent of the order of
// comparisons. Throws InputError for a coordinate that is not finite in float32.
std::vector<AccelTriangle> accel_triangles(const Scene& scene);

}  // namespace wavetracer
