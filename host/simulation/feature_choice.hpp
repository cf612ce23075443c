// SPDX-License-Identifier: Apache-2.0
// Chooses the features that a run computes: those that the configuration asks for and that the scene needs. A feature
// that is off makes no pass, runs no kernel and takes no memory.
#pragma once
#include "simulation/world.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// Throws ConfigError if materials of the scene or of vehicles are not known at the carrier, and names all of them.
Features choose_features(const Config& config, const Scene& scene, const World& world);

// A copy of trace in which all features that are off are switched off.
TraceConfig with_features(TraceConfig trace, const Features& features);

}  // namespace wavetracer
