// SPDX-License-Identifier: Apache-2.0
// Decides areas where surfaces of several materials share one plane: each area is given to one of them, whatever their
// order in the file.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Cuts out of every surface the parts that smaller surfaces of other materials cover (cover_order.hpp,
// coplanar_pairs.hpp), so that each place has one material. Surfaces keep their planes, except that a surface within
// rounding of a larger one's plane takes that (cover_order.hpp). A cut surface may have several parts; parts narrower
// than the distance by which welding moves vertices are dropped. Edges and surfaces are found anew. The report gets the
// area, and warnings say which materials share a place that can be seen (body_sides.hpp), and which one counts there.
// It does nothing where nothing overlaps. The scene's surfaces must be known; triangle_edges: as find_edges() returns
// them.
void cut_covered_faces(Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges);

}  // namespace wavetracer
