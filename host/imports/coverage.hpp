// SPDX-License-Identifier: Apache-2.0
// Computes which share of a polygon is covered by others, seen from above.
#pragma once
#include <span>

#include "imports/rings.hpp"

namespace wavetracer::imports {

// Returns the share of the area of a polygon that lies in at least one of the others, 0 to 1. It is exact along x and
// measured on 256 lines along y, so the error is a few parts in a thousand.
double covered_share(const Polygon& polygon, std::span<const Polygon* const> others);

}  // namespace wavetracer::imports
