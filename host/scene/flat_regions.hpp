// SPDX-License-Identifier: Apache-2.0
// Finds regions of a mesh that are one plane within a tolerance, which were planes before their coordinates were
// rounded or measured. The mesh must be welded and have its edges (host/scene/topology.hpp).
#pragma once
#include <vector>

#include "scene/flat_mesh.hpp"

namespace wavetracer {

// Divides triangles into regions, largest planes first. The rules:
//
// 1. A region grows from the largest triangle that is left, over edges and over T-junctions, as long as all corners are
//   within 0.1 mm of that triangle's plane. Such a region is exact.
// 2. It grows on as long as all of its vertices are within their tolerances of the plane that fits them best. Triangles
//   that turn by more than 10 degrees or fold back over the region stay outside, so steps, chamfers and the two sides
//   of a thin plate are kept.
// 3. Neighbours that are within the tolerances of one plane are joined, those that fit best first.
// 4. Triangles that are within the tolerances of two neighbours go to the one on whose side of their line they are.
// 5. A region is dropped if its surface continues as a curve beyond its border, and the region itself is curved by more
//   than its noise: its triangles are in no region and stay unchanged.
//
// The result does not depend on the order of triangles and vertices.
std::vector<FlatRegion> find_flat_regions(const FlatMesh& mesh);

}  // namespace wavetracer
