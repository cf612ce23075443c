// SPDX-License-Identifier: Apache-2.0
// Checks whether a scene can be in metres: in files in millimetres, houses are kilometres high.
#pragma once
#include <string>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Returns a warning that names the object and its height and says what to do; empty if the sizes are possible.
std::string unit_warning(const Scene& scene);

}  // namespace wavetracer
