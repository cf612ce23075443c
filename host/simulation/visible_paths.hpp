// Visible solved paths of the device as path geometry on the host, each path once.
// Assumes occlusion has run.
#pragma once
#include "passes/solved_list.hpp"
#include "wavetracer/path_geometry.hpp"

namespace wavetracer {

// The paths that are not blocked, in the order and merged by the rule of distinct_paths: independent of the order on
// the device.
PathGeometry visible_paths(const SolvedList& solved);

}  // namespace wavetracer
