// SPDX-License-Identifier: Apache-2.0
// The steps that follow once flat regions have grown, in their order (rules 3 to 5 of flat_regions.hpp).
#pragma once
#include <vector>

#include "scene/flat_mesh.hpp"

namespace wavetracer {

// Joins neighbouring flat regions that are one plane within the tolerance. The joined region takes the place of its
// first part; the other parts are removed.
void join_regions(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions);

// Moves the border between flat regions to the line where their planes meet. A region that grew first has taken
// triangles beyond the line where the next plane begins, as far as they are within the tolerance of both. They are
// given to the region on whose side of the line they lie.
void straighten_borders(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions);

// Removes regions that are pieces of a curved surface, to tell a plane with noise from them: more than a quarter of
// their border leads to triangles that turn by less than 10 degrees, and either they have no more than 16 vertices, or
// a quadratic surface is at least ten times as close to the vertices as the plane.
void give_back_curved(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions);

}  // namespace wavetracer
