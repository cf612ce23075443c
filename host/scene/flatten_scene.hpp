// SPDX-License-Identifier: Apache-2.0
// The step of build_scene() that puts vertices onto their planes.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "scene/flatten.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Moves the vertices of a scene within tolerance_m, or twice the rounding of a vertex where that is more, and notes in
// the report what was moved. Zero moves nothing at all.
Flattened flatten_scene(Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges, double tolerance_m,
                        std::span<const double> rounding_m);

}  // namespace wavetracer
