// SPDX-License-Identifier: Apache-2.0
// The outer sides of surfaces whose material has several layers.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Sets Surface::outer_is_below. The outer side of a surface that bounds a body (body_sides.hpp) is the one without the
// body; that of any other surface is the side from which the corners of most of its area run counter-clockwise. Assumes
// what BodySides assumes. Surfaces of other materials are left alone.
void find_outer_sides(Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges);

}  // namespace wavetracer
