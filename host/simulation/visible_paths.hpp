// Visible solved paths of the device as path geometry on the host.
// Assumes occlusion has run.
#pragma once
#include "passes/solved_list.hpp"
#include "wavetracer/path_geometry.hpp"

namespace wavetracer {

// Appends the paths that are not blocked, as they come; distinct_paths then makes them independent of the order on the
// device.
void append_visible(const SolvedList& solved, PathGeometry& paths);

}  // namespace wavetracer
