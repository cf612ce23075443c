// Tells if a scene can be in metres: files in millimetres have houses of kilometres.
#pragma once
#include <string>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// A warning that names the object and its height, and says what to do; empty where all is of a possible size.
std::string unit_warning(const Scene& scene);

}  // namespace wavetracer
