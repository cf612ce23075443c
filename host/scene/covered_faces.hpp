// Places that surfaces of several materials share in one plane: one of them gets each place, whatever the order of the
// file.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Cuts out of every surface what smaller ones of other materials cover (cover_order.hpp, coplanar_pairs.hpp), so that
// there is one material in each place. Surfaces keep their planes, but for what shares that of a larger one within
// rounding (cover_planes.hpp), and what is left of their triangles, in as many parts as that may be; what is narrower
// than welding moves vertices is left out. Edges and surfaces are found anew. Notes the area in the report, and says in
// warnings which materials share a place that can be seen (body_sides.hpp), and which one counts there. Does nothing
// where nothing overlaps. Assumes a scene with its surfaces; triangle_edges as find_edges() returns them.
void cut_covered_faces(Scene& scene, std::span<const std::array<uint32_t, 3>> triangle_edges);

}  // namespace wavetracer
