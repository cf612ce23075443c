// SPDX-License-Identifier: Apache-2.0
// The largest distance of anything from the middle of the scene in a drive, and its limit.
// Assumes recentred coordinates; messages give those of the files.
#pragma once
#include <optional>

#include "motion/trajectories.hpp"
#include "simulation/live_places.hpp"
#include "simulation/world_ends.hpp"
#include "simulation/world_fleet.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

// As far as a scene may extend. Rays are traced in float32, which tells places at this distance apart by 6 cm, and what
// is far away widens the boxes of the trees, and so slows down the rays of all.
constexpr double farthest_m = 1e6;

// Returns the reach of a world: no recentred coordinate of an end, of a target or of a corner of an instance is larger,
// in any frame. live: the places of a live world, whose vehicles may be anywhere in their bounds; empty for tracks.
// Throws ConfigError or InputError for a place beyond farthest_m, and for NaN.
double reach_of(const Fleet& fleet, const WorldEnds& ends, const Targets& targets,
                const std::optional<LivePlaces>& live, const Scene& scene);

}  // namespace wavetracer
