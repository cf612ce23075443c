// SPDX-License-Identifier: Apache-2.0
// Chooses the features that a run computes: those that the configuration asks for and that the scene needs. A feature
// that is off makes no pass, runs no kernel and takes no memory.
#pragma once
#include "simulation/world.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// With trace.discovery = "auto", beams are chosen for one frame in which nothing moves, with at most these surfaces and
// trace.max_depth, for reflections and edges. Then the complete list takes a few times as long as a frame of the
// default number of rays (docs/design/measurements.md, "Rays or beams for one frame").
inline constexpr size_t auto_beam_surfaces = 4000;
inline constexpr uint32_t auto_beam_depth = 6;

// frames_follow: see plan_run(). Throws ConfigError if materials of the scene or of vehicles are not known at the
// carrier, and names all of them.
Features choose_features(const Config& config, const Scene& scene, const World& world, bool frames_follow = false);

// A copy of trace in which all features that are off are switched off, and whose discovery is "rays" or "beams".
TraceConfig with_features(TraceConfig trace, const Features& features);

}  // namespace wavetracer
