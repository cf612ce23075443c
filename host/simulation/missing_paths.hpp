// Why links of a frame have no path, in words: what their direct lines meet first, and what might lead around it.
// Assumes the states of the frame as they were solved.
#pragma once
#include "simulation/surroundings.hpp"
#include "simulation/world.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// config: as it was given; features: which of its features are on.
MissingLinks explain_missing(const Config& config, const Features& features, const Surroundings& around,
                             const World& world, const FrameResult& frame);

}  // namespace wavetracer
