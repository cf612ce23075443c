// SPDX-License-Identifier: Apache-2.0
// Moves the border between flat regions to the line where their planes meet (rule 4 of flat_regions.hpp).
#pragma once
#include <vector>

#include "scene/flat_neighbours.hpp"
#include "scene/flat_regions.hpp"

namespace wavetracer {

// A region that grew first has taken triangles beyond the line where the next plane begins, as far as they are within
// the tolerance of both. They are given to the region on whose side of the line they lie.
void straighten_borders(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions);

}  // namespace wavetracer
