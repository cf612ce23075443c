// SPDX-License-Identifier: Apache-2.0
// The targets of a world: vehicles that a [[target_model]] selects, by track and then by model, and then those that
// stand ([[target]]).
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "simulation/target_parts.hpp"
#include "simulation/world_ends.hpp"
#include "simulation/world_fleet.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/device/points.h"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

struct Target {
  std::string name, model;          // VEHICLE/MODEL for a vehicle; the name of the [[target_model]]
  std::optional<uint32_t> track;    // the vehicle
  uint32_t instance = no_instance;  // its body
  Pose pose = {};                   // pose of a target that stands, recentred
  uint32_t first_point = 0;         // its points follow each other
  uint32_t point_count = 0;
};

// A point of a target: its place on it, and its law (radio/target_laws.hpp). part: that of a point that moves on it.
struct TargetPoint {
  uint32_t target, law;
  glm::dvec3 arm_m{0};
  std::optional<PartPoint> part = {};
  uint32_t surface = no_target_surface;  // the surface in the world of a piece of a body; see TargetState
  bool lit_above = false, lit_below = false;

  // A bound of its radar cross section, and the area of a piece of a body instead.
  double section_m2 = 0, area_m2 = 0;

  // A bound of the gain between isotropic antennas of a path over it whose parts before and after it are 1 m long.
  double power(double wavelength_m) const;
  // Its largest distance from the middle of the footprint.
  double reach_m() const;
};

struct Targets {
  std::vector<Target> all;
  std::vector<TargetPoint> points;
  std::vector<wt_target_bounce> bounces;       // within the bodies of targets
  std::vector<std::optional<Travel>> travels;  // by track: the ways of those that have parts; empty without any

  bool empty() const { return points.empty(); }
};

// ends: those of the world. by_id: see with_mounts. Throws ConfigError for a pattern that nothing has, and for a
// vehicle with an antenna and without a body, from whose antenna nothing would keep its own points, and for one without
// a body whose body is the target.
Targets make_targets(const Config& config, const Fleet& fleet, const WorldEnds& ends, const glm::dvec3& origin_m,
                     bool by_id);

// For each instance 1 if its body is a target itself, else 0; empty where none is.
std::vector<uint32_t> body_instances(const Targets& targets, const Fleet& fleet);

// The points at this time, where the vehicles are in these states, one for each track.
std::vector<TargetState> targets_at(const Targets& targets, const Fleet& fleet,
                                    const std::vector<VehicleState>& vehicles, double time_s);

// Says by which target each path goes, in Paths::target, and numbers points within their target. The paths must have
// the numbers of points of the world.
void name_targets(Paths& paths, const Targets& targets);

}  // namespace wavetracer
