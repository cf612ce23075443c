// Paths in the order of their links, each once.
// Rows may come in any order; the result depends only on the rows, and not on the number of threads.
#pragma once
#include "wavetracer/path_geometry.hpp"

namespace wavetracer {

// Two solutions are one path when ends and depth agree and every vertex does to merge_distance_m: a point on the border
// of two coplanar surfaces, or on two walls that touch, belongs to both. The one with the lowest surfaces stays.
constexpr double merge_distance_m = 1e-4;

// Rows sorted by transmitter, receiver, depth, surfaces and interactions. Of rows of one link with the same surfaces
// and interactions, which are one path, the first that came stays.
PathGeometry distinct_paths(const PathGeometry& found);

}  // namespace wavetracer
