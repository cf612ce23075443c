// SPDX-License-Identifier: Apache-2.0
// Maps of streets alone.
#pragma once
#include <span>
#include <vector>
#include "coverage/coverage_map.hpp"
#include "scene/streets.hpp"

namespace wavetracer::coverage {

// Returns for each cell of a horizontal map whether its middle lies on a street: at most half of the street's width
// from its centre line, seen from above. streets: in file coordinates.
std::vector<bool> cells_on_streets(const Map& map, std::span<const Street> streets);

// Leaves the cells without values that are not on streets.
void keep_streets(Map& map, const std::vector<bool>& on_street);

}  // namespace wavetracer::coverage
