// SPDX-License-Identifier: Apache-2.0
// The bodies of targets that stand ([[target]] with vehicle_type): instances without a track.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "motion/pose.hpp"
#include "simulation/world_models.hpp"
#include "wavetracer/config.hpp"

namespace wavetracer {

struct StandingBody {
  uint32_t target;  // the number of its [[target]]
  uint32_t model;   // in VehicleModels::models
  std::string type;
  Pose pose;  // recentred
};

// The pose of a target that stands, recentred.
Pose standing_pose(const TargetConfig& target, const glm::dvec3& origin_m);

// Builds the bodies, in the order of the targets. Throws ConfigError for a type that nothing knows or that has no body.
std::vector<StandingBody> standing_bodies(const Config& config, VehicleModels& vehicles, const glm::dvec3& origin_m);

}  // namespace wavetracer
