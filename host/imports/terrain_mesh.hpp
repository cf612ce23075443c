// SPDX-License-Identifier: Apache-2.0
// Approximates heights on a grid by few triangles: posts are added where the mesh has the largest error, until no error
// exceeds a limit (M. Garland and P. Heckbert, "Fast polygonal approximation of terrains and height fields",
// CMU-CS-95-181, 1995). Triangles are Delaunay's.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "scene/raw_scene.hpp"

namespace wavetracer::imports {

struct GridPost {
  int32_t column = 0, row = 0;
  bool operator==(const GridPost&) const = default;
};

struct TerrainMesh {
  std::vector<GridPost> posts;
  std::vector<Triangle> triangles;  // counter-clockwise where row numbers go up: column to the right and row upward
};

// heights: rows of `columns` values, all finite. columns and rows are 2 to 2^14; error_m is positive.
TerrainMesh mesh_terrain(int32_t columns, int32_t rows, std::span<const float> heights_m, double error_m);

// Errors of the mesh over all posts: the largest one and the root mean square.
struct TerrainError {
  double largest_m = 0, rms_m = 0;
};
TerrainError terrain_error(const TerrainMesh& mesh, int32_t columns, std::span<const float> heights_m);

}  // namespace wavetracer::imports
