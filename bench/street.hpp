// SPDX-License-Identifier: Apache-2.0
// Finds places for antennas in the streets of a city: points with nothing but sky above them.
// Streets are at z = 0 of the file's coordinates, as in munich and in the generated city.
#pragma once
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer::bench {

// Returns `count` points at height_m within radius_m of centre_m, file coordinates, to a millimetre. A point is
// accepted if a ray straight down from the sky meets the ground first. The same arguments give the same points
// everywhere. Throws InputError where hardly any place is open.
std::vector<glm::dvec3> street_points(const Scene& scene, glm::dvec3 centre_m, double radius_m, double height_m,
                                      size_t count);

}  // namespace wavetracer::bench
