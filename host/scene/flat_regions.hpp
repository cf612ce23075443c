// Regions of a mesh that are one plane within a tolerance: what was a plane before coordinates were rounded or
// measured. Assumes a welded mesh with its edges (host/scene/topology.hpp).
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/plane_fit.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

struct FlatRegion {
  std::vector<uint32_t> triangles, vertices;  // each once
  Plane plane;                                // that of its largest triangle if it is exact, else the fitted one
  bool exact = true;                          // flat as it is: its vertices need not move
};

// What the search knows of the mesh.
struct FlatMesh {
  const Scene& scene;
  std::span<const std::array<uint32_t, 3>> triangle_edges;
  std::span<const double> tolerance_m;  // per vertex
};

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
