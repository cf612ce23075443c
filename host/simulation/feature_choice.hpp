// What a run computes: what the configuration asks for, as far as the scene needs it.
// What is off makes no pass, launches no kernel and holds no memory.
#pragma once
#include "simulation/world.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

Features choose_features(const Config& config, const Scene& scene, const World& world);

// trace with everything switched off that is not on.
TraceConfig with_features(TraceConfig trace, const Features& features);

}  // namespace wavetracer
