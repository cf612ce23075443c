// SPDX-License-Identifier: Apache-2.0
// Finds bodies: sets of triangles that are connected by shared edges.
#pragma once
#include <cstdint>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Returns the body of each triangle. Bodies are numbered from 0 in the order of their first triangles.
std::vector<uint32_t> bodies_of(const Scene& scene);

}  // namespace wavetracer
