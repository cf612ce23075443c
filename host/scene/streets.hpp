// SPDX-License-Identifier: Apache-2.0
// Streets as lines with a width, for pictures only: no ray meets them.
#pragma once
#include <glm/vec3.hpp>
#include <vector>

#include "scene/city.hpp"

namespace wavetracer {

struct Street {
  std::vector<glm::dvec3> centre_m;  // two points or more, in the coordinates of the scene file
  double width_m;
};

// Returns the streets between the blocks of a generated city, and those around it.
std::vector<Street> city_streets(const CityOptions& options);

}  // namespace wavetracer
