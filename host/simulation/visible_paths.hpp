// The visible paths of the last frame, read back to the host.
#pragma once
#include "simulation/setup.hpp"
#include "wavetracer/path_geometry.hpp"

namespace wavetracer {

// As `fields` takes them: numbered through the world, equal paths included.
PathGeometry read_visible(Setup& setup);

}  // namespace wavetracer
