// SPDX-License-Identifier: Apache-2.0
// The vehicles of a world: their tracks, and the bodies of those that have one.
// Everything is in coordinates of the recentred scene.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "motion/pose.hpp"
#include "motion/trajectories.hpp"
#include "motion/travel.hpp"
#include "simulation/standing_bodies.hpp"
#include "simulation/world_models.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct Fleet {
  Trajectories trajectories;  // a live world has a track for each place
  std::vector<Scene> models;  // they are recentred like any Scene; placement_of() takes their origin into account
  std::vector<Instance> instances;
  std::vector<uint32_t> instance_of_track;  // no_instance where the vehicle has no body
  std::vector<uint32_t> track_of_instance;  // those of tracks; further instances are bodies that stand
  std::vector<StandingBody> standing;

  // The instance of a body that stands, by its place in `standing`.
  uint32_t instance_of_standing(size_t i) const { return static_cast<uint32_t>(track_of_instance.size() + i); }
};

// The fleet of these tracks and bodies that stand. vehicles: they build the body of each type once. Surfaces and wedges
// of instances are numbered behind those of the scene. Throws ConfigError or InputError for a body that cannot be made,
// RuntimeError for more surfaces or edges than a sequence can name.
Fleet make_fleet(Trajectories trajectories, std::vector<StandingBody> standing, const Config& config,
                 VehicleModels vehicles, const Scene& scene);

// A vehicle at one instant. Where it is absent, it is as it was last, or will be first.
struct VehicleState {
  Pose pose;
  bool present;
  std::optional<Travelled> travelled = {};  // in a live world: its way; else it follows from its track
};
VehicleState vehicle_at(const Track& track, double time_s);

// A place on a vehicle, arm_m from its origin in its own axes (ahead, left, up), and how fast that place moves.
glm::dvec3 position_at(const Pose& pose, const glm::dvec3& arm_m);
glm::dvec3 velocity_at(const Pose& pose, const glm::dvec3& arm_m);

// The body of a vehicle in this state. model: the body's.
Placement placement_of(const Scene& model, const VehicleState& vehicle);

// A warning if vehicles are outside of the scene on all of their ways; empty if none is.
std::vector<std::string> outside_warning(const Trajectories& trajectories, const Scene& scene);

}  // namespace wavetracer
