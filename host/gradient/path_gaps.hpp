// SPDX-License-Identifier: Apache-2.0
// Paths that have no derivatives by the places or the turns of their ends.
#pragma once
#include "gradient/path_gradient.hpp"
#include "wavetracer/device/path_world.h"

namespace wavetracer {

// The gap of a path's derivatives by turns of its antennas.
GradientGap gap_of_turns(const device::wt_field_world& world, const device::wt_path& path);
// The gap of those by positions, of a path whose vertices are solved.
GradientGap gap_of_positions(const device::wt_field_world& world, const device::wt_path& path);

}  // namespace wavetracer
