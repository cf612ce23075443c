// SPDX-License-Identifier: Apache-2.0
// Splits polygons into triangles: a fan where the polygon is convex, ears where it is not.
// Polygons must be simple (no self-intersection) and planar up to noise; there are no holes.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "scene/raw_scene.hpp"

namespace wavetracer {

// Appends polygon.size() - 2 triangles (indices into vertices, winding kept) to out.
void triangulate_polygon(std::span<const glm::dvec3> vertices, std::span<const uint32_t> polygon,
                         std::vector<Triangle>& out);

}  // namespace wavetracer
