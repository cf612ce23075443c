// Triangles of different materials that lie on each other in one plane, as those of a road drawn on the ground.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "wavetracer/scene.hpp"

namespace wavetracer {

// Pairs of triangles, the lower number first, each pair once, in ascending order. Two triangles are in one plane where
// the corners of one are within 0.1 mm of the plane of the other's surface, whichever way they are wound; those that
// overlap by less than what welding moves only touch. Assumes a scene whose surfaces are known. The time is that of a
// grid over the surfaces where nothing overlaps.
std::vector<std::pair<uint32_t, uint32_t>> coplanar_pairs(const Scene& scene);

}  // namespace wavetracer
