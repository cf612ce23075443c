// Which triangles belong together: a body is what edges join.
#pragma once
#include <cstdint>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// The number of the body of each triangle, counted from 0 in the order of their first triangles.
std::vector<uint32_t> bodies_of(const Scene& scene);

}  // namespace wavetracer
