// SPDX-License-Identifier: Apache-2.0
// The trajectories of a configuration: those of a file or of generated traffic, those of [[track]] waypoints, and
// vehicles that are [[parked]].
// Assumes that file and generate are not both given.
#pragma once
#include "motion/trajectories.hpp"
#include "simulation/place_finder.hpp"
#include "simulation/world_models.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

// In coordinates of the scene file, each vehicle id once; empty where nothing moves. Throws ConfigError or InputError.
Trajectories load_trajectories(const Config& config, const VehicleModels& vehicles, PlaceFinder& places);

// No coordinate of any pose of the track, at any time, is outside of these bounds.
struct Bounds {
  glm::dvec3 lower, upper;
};
Bounds bounds_of(const Track& track);

}  // namespace wavetracer
