// SPDX-License-Identifier: Apache-2.0
// Distinguishes a plane with noise from a piece of a curved surface (rule 5 of flat_regions.hpp).
#pragma once
#include <vector>

#include "scene/flat_neighbours.hpp"
#include "scene/flat_regions.hpp"

namespace wavetracer {

// Removes regions that are pieces of a curved surface: more than a quarter of their border leads to triangles that turn
// by less than 10 degrees, and either they have no more than 16 vertices, or a quadratic surface is at least ten times
// as close to the vertices as the plane.
void give_back_curved(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions);

}  // namespace wavetracer
