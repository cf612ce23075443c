// SPDX-License-Identifier: Apache-2.0
// Places of a live world: one per possible vehicle, grouped by type, and the place of each vehicle of a client.
// Instances and ends are made once, so a new vehicle takes a free place.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "motion/pose.hpp"
#include "motion/trajectories.hpp"
#include "motion/travel.hpp"
#include "simulation/world_models.hpp"
#include "wavetracer/live.hpp"

namespace wavetracer {

struct PlacedPose {
  uint32_t place;  // index of its track
  Pose pose;       // recentred
  std::string id;
  bool arrives = false;  // it was not present in the frame before, or has jumped
  Travelled travelled = {};
};

class LivePlaces {
 public:
  // Throws ConfigError for a type that is unknown or occurs twice, and if there are trajectories as well.
  LivePlaces(const Config& config, const VehicleModels& vehicles, const Scene& scene);

  // Gives each place a track, TYPE.NUMBER, of one sample: the middle of the scene, with no vehicle present. File
  // coordinates.
  Trajectories tracks() const;
  const std::vector<LiveType>& types() const { return types_; }
  const LiveBounds& bounds() const { return bounds_; }  // file coordinates

  // Puts the vehicles of a frame into places: those of the last frame keep theirs, others take the first free one of
  // their type. Updates the traffic; if it throws PoseError, it leaves the traffic as it was.
  std::vector<PlacedPose> place(LiveTraffic& traffic, double time_s, std::span<const LivePose> poses) const;

  // The vehicles at a time between the last two frames, both included: those that were in both, on the cubic through
  // the positions and velocities of both, turning evenly; a vehicle that jumps stays at its old place. At the time of a
  // frame also those that were only in that frame. Throws PoseError for another time, or if there are no two frames.
  std::vector<PlacedPose> between(const LiveTraffic& traffic, double time_s) const;

 private:
  const LiveType& type_of(const LivePose& pose) const;
  void check(const LivePose& pose) const;
  uint32_t free_place(const LivePose& pose, std::vector<bool>& taken) const;

  std::vector<LiveType> types_;
  LiveBounds bounds_;
  glm::dvec3 origin_m_;
  uint32_t count_ = 0;  // number of places
};

}  // namespace wavetracer
