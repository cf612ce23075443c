// SPDX-License-Identifier: Apache-2.0
// Joins neighbouring flat regions that are one plane within the tolerance (rule 3 of flat_regions.hpp).
#pragma once
#include <vector>

#include "scene/flat_neighbours.hpp"
#include "scene/flat_regions.hpp"

namespace wavetracer {

// The joined region takes the place of its first part; the other parts are removed.
void join_regions(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions);

}  // namespace wavetracer
