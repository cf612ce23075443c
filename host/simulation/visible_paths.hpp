// SPDX-License-Identifier: Apache-2.0
// The visible paths of the last frame, read back to the host.
#pragma once
#include "simulation/setup.hpp"
#include "wavetracer/path_geometry.hpp"

namespace wavetracer {

// Reads the paths in the form that `fields` takes: numbers are those of the world, and equal paths are included.
PathGeometry read_visible(Setup& setup);

}  // namespace wavetracer
