// SPDX-License-Identifier: Apache-2.0
// Finds triangles of different materials that lie on each other in one plane, such as those of a road drawn on the
// ground.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Returns pairs of triangles, the lower number first, each pair once, in ascending order. Two triangles are in one
// plane if the corners of one are within 0.1 mm of the plane of the other's surface, whichever way they are wound.
// Triangles that overlap by less than welding moves vertices only touch, and are no pair. The scene's surfaces must be
// known. Where nothing overlaps, the time is that of a grid over the surfaces.
std::vector<std::pair<uint32_t, uint32_t>> coplanar_pairs(const Scene& scene);

}  // namespace wavetracer
