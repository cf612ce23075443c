// Surfaces that lie in one plane but for the rounding of their corners get one plane.
#pragma once
#include <cstdint>
#include <span>
#include <utility>

#include "scene/cover_order.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Gives a surface that covers others the plane of the largest one of them, where that is within 0.1 mm of all of its
// corners and turns it by more than rounding in double does. So a door drawn on a wall mirrors as the wall does, and
// their border is no bend at which waves diffract. No vertex is moved. pairs: triangles, the covered one first.
void share_planes(Scene& scene, const CoverOrder& order, std::span<const std::pair<uint32_t, uint32_t>> pairs);

}  // namespace wavetracer
