// Visible solved paths of the device as path geometry on the host, each path once.
// Assumes occlusion has run.
#pragma once
#include "passes/solved_list.hpp"
#include "wavetracer/path_geometry.hpp"

namespace wavetracer {

// Two solutions are one path when ends and depth agree and every vertex does to merge_distance_m: a point on the border
// of two coplanar surfaces, or on two walls that touch, belongs to both. The one with the lowest surfaces stays.
constexpr double merge_distance_m = 1e-4;

// Rows sorted by transmitter, receiver, depth and sequence: independent of the order on the device.
PathGeometry visible_paths(const SolvedList& solved);

}  // namespace wavetracer
