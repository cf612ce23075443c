// Regions of a mesh that are one plane within a tolerance: what was a plane before coordinates were rounded or
// measured. Assumes a welded mesh with its edges (host/scene/topology.hpp).
#pragma once
#include <vector>

#include "scene/flat_mesh.hpp"

namespace wavetracer {

// Divides triangles into regions, largest planes first. The rules:
//
// 1. A region grows from the largest triangle that is left, over edges and over T-junctions, as long as all corners are
//    within 0.1 mm of that triangle's plane. Then it is exact.
// 2. It grows on as long as all of its vertices are within their tolerances of the plane that fits them best. Triangles
//    that turn by more than 10 degrees stay outside, and those that fold back over the region, so steps, chamfers and
//    the two sides of a thin plate stay what they are.
// 3. Neighbours that are within the tolerances of one plane are joined, those that fit best first.
// 4. Triangles that are within the tolerances of two neighbours go to the one on whose side of their line they are.
// 5. A region that only ended because the surface goes on to curve, and that is curved itself by more than it is noisy,
//    is none: its triangles are in no region, and stay as they are.
//
// The result does not depend on the order of triangles and vertices.
std::vector<FlatRegion> find_flat_regions(const FlatMesh& mesh);

}  // namespace wavetracer
