// Why links of a frame have no path, in words: what their direct lines meet first, and what might lead around it.
// A few links are named, the others counted. Receivers of grids are left out, unless no link of the frame has a path.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "simulation/surroundings.hpp"
#include "simulation/world.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// config: as it was asked for; features: what of it is on. found: the links of this frame that have a path, sorted.
std::vector<std::string> explain_missing(const Config& config, const Features& features, const Surroundings& around,
                                         const World& world, uint64_t frame, std::span<const Link> found);

}  // namespace wavetracer
