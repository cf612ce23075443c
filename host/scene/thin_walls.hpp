// SPDX-License-Identifier: Apache-2.0
// Walls that are thinner than edges can be told apart: both sides become one sheet, whose rims diffract.
// Assumes welded vertices.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "scene/weld.hpp"

namespace wavetracer {

// As thick as what edge_pieces.hpp takes for one place: the two edges of a thinner wall would be one, with a roof
// between.
constexpr double thin_wall_m = 2e-3;

// Joins the vertices at the short sides of strips: triangles with one side of at most thin_wall_m, fifty times shorter
// than the others, as the roof of a thin wall has them, from whose long sides faces go the same way. A vertex is joined
// once, so that strips beside each other, as of a finely bent surface, do not become one point. triangles: of the
// vertices before they were welded. Joined vertices are halfway between both. Returns their number.
uint64_t join_thin_walls(std::span<const std::array<uint32_t, 3>> triangles, Weld& weld);

}  // namespace wavetracer
