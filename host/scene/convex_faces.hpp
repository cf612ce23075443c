// SPDX-License-Identifier: Apache-2.0
// Surfaces that are convex polygons without holes, stored as half planes whose intersection they are. Such a surface
// hides one convex set from another if it hides all corners of the one from all corners of the other.
#pragma once
#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// The sides of surface s are sides[first[s]] to sides[first[s + 1]]; there are none if it is not such a polygon or has
// more than max_face_sides. A point p of its plane is inside a side (normal, offset in m) if dot(normal, p) >= offset.
struct ConvexFaces {
  std::vector<uint32_t> first;
  std::vector<glm::dvec4> sides;
};

constexpr uint32_t max_face_sides = 12;

ConvexFaces convex_faces(const Scene& scene);

}  // namespace wavetracer
