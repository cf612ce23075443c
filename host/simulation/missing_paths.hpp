// SPDX-License-Identifier: Apache-2.0
// Says in words why links of a frame have no path: what their direct lines meet first, and which mechanism might lead
// around it. The states must be those with which the frame was solved.
#pragma once
#include <vector>

#include "simulation/surroundings.hpp"
#include "simulation/world.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// Returns the links of the frame that have no path, in their order.
std::vector<Link> links_without_path(const FrameResult& frame);

// config: as it was given; features: the features that are on.
MissingLinks explain_missing(const Config& config, const Features& features, const Surroundings& around,
                             const World& world, const FrameResult& frame);

}  // namespace wavetracer
