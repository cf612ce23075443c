// Tells a plane with noise from a piece of a curved surface (rule 5 of flat_regions.hpp).
#pragma once
#include <vector>

#include "scene/flat_neighbours.hpp"
#include "scene/flat_regions.hpp"

namespace wavetracer {

// Takes out regions that a curved surface was cut into: more than a quarter of their border leads to triangles that
// turn by less than 10 degrees, and either it has no more than 16 vertices, or a surface of second degree is at least
// ten times as close to them as the plane.
void give_back_curved(const FlatMesh& mesh, const FlatNeighbours& neighbours, std::vector<FlatRegion>& regions);

}  // namespace wavetracer
