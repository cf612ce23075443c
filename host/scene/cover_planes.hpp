// SPDX-License-Identifier: Apache-2.0
// Gives surfaces that lie in one plane, up to the rounding of their corners, the same plane.
#pragma once
#include <cstdint>
#include <span>
#include <utility>

#include "scene/cover_order.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Gives a surface that covers others the plane of the largest of them, if that plane is within 0.1 mm of all its
// corners and differs from its own by more than rounding in double. So a door drawn on a wall mirrors as the wall does,
// and the border between them is no bend at which waves diffract. No vertex is moved. pairs: triangles, the covered one
// first.
void share_planes(Scene& scene, const CoverOrder& order, std::span<const std::pair<uint32_t, uint32_t>> pairs);

}  // namespace wavetracer
