// SPDX-License-Identifier: Apache-2.0
// The distance between neighbouring rays of a launch where the other ends of its links are. Rays that are farther apart
// than houses do not show what they miss: a house that no ray meets leaves no trace in the launch.
#pragma once
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "passes/generate_rays.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

// The area in m^2 at a place that all rays of this launcher would share, if its launch were everywhere as dense as
// towards that place: for an even launch the sphere around the antenna. The root of this area by the number of rays is
// the distance between neighbouring rays there. Infinite where the launch sends no ray. at: in recentred metres.
// tables: as LaunchHeights takes them; by_table: directions that are no window are spread by a table, too.
double spread_m2(const Launcher& from, std::span<const float> tables, bool by_table, const glm::dvec3& at);

// The largest such area over these links, which are sorted; of several launchers of a transmitter, sorted as well, the
// densest counts. Links to which no launcher sends are left out. 0 without links.
double widest_spread_m2(std::span<const Launcher> launchers, std::span<const float> tables, bool by_table,
                        std::span<const Link> links, std::span<const EndState> receivers);

}  // namespace wavetracer
