// Joins neighbouring flat regions that are one plane within the tolerance (rule 3 of flat_regions.hpp).
#pragma once
#include <vector>

#include "scene/flat_neighbours.hpp"
#include "scene/flat_regions.hpp"

namespace wavetracer {

// Cosine of 10 degrees: triangles and regions of one plane turn by less, but for slivers between them.
constexpr double least_cosine = 0.985;

// What was joined is one region, at the place of the first; the others are gone.
void join_regions(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions);

}  // namespace wavetracer
