// SPDX-License-Identifier: Apache-2.0
// Rays from edges (trace.edge_rays): what they do not go with, and their number where the configuration leaves it to
// the program.
#pragma once
#include <cstdint>
#include <vector>

#include "config/contradictions.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer::config {

// Returns the number of receivers that are not transmitters too: with diffraction they launch rays of their own.
uint64_t listener_count(const Config& config);

void check_edge_rays(const Config& config, std::vector<Contradiction>& out);

// Returns the number of rays from each edge in a world in which nothing moves: trace.edge_rays, or with "auto"
// automatic_edge_rays where there are more receivers than many_listeners that do not transmit, and 0 elsewhere. config:
// with all ends of the world. trace: [trace] of it, without what the scene does not need.
uint64_t edge_rays_of(const Config& config, const TraceConfig& trace);

// With so many the map of docs/scenarios.md misses 1.8 10^-4 of its power.
inline constexpr uint64_t automatic_edge_rays = 3000;
// With their own rays so many launch 10^8, half of what the edges of 2 km x 2 km of city do.
inline constexpr uint64_t many_listeners = 1000;

}  // namespace wavetracer::config
