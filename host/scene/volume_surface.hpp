// SPDX-License-Identifier: Apache-2.0
// The surfaces of volumes as triangles, for drawing them and for scattering off them.
#pragma once
#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Returns closed surfaces, counter-clockwise seen from outside, in the coordinates of the volume. Cylinders and
// spheroids have their corners on the true surface: 16 sides, and 8 rows from pole to pole.
std::vector<std::array<glm::dvec3, 3>> surface_triangles(const Volume& volume);

}  // namespace wavetracer
