// Computes how much of a polygon others cover, seen from above.
#pragma once
#include <span>

#include "imports/rings.hpp"

namespace wavetracer::imports {

// The share of the area of a polygon that lies in one of the others or in several, 0 to 1. It is exact along x and
// measured on 256 lines along y, so it is right to a few parts in a thousand.
double covered_share(const Polygon& polygon, std::span<const Polygon* const> others);

}  // namespace wavetracer::imports
