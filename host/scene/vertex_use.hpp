// SPDX-License-Identifier: Apache-2.0
// Finds the vertices that triangles of a scene use.
#pragma once
#include <cstdint>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Removes vertices that no triangle uses, keeping the order of the others. Returns the former number of each that is
// left.
std::vector<uint32_t> drop_unused_vertices(Scene& scene);

}  // namespace wavetracer
