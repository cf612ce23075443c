// Joins neighbouring flat regions that are one plane within the tolerance (rule 3 of flat_regions.hpp).
#pragma once
#include <vector>

#include "scene/flat_neighbours.hpp"
#include "scene/flat_regions.hpp"

namespace wavetracer {

// Regions that were joined are one, at the place of the first; the others are gone.
void join_regions(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions);

}  // namespace wavetracer
