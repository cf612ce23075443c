// Places of a live world: one per possible vehicle, grouped by type, and which vehicle of a client has which place.
// Assumes that instances and ends are made once, so that a vehicle that comes takes a place that is free.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "motion/pose.hpp"
#include "motion/trajectories.hpp"
#include "simulation/world_models.hpp"
#include "wavetracer/live.hpp"

namespace wavetracer {

struct PlacedPose {
  uint32_t place;  // the index of its track
  Pose pose;       // recentred
  std::string id;
  bool arrives = false;  // it was not there in the frame before, or has jumped
};

class LivePlaces {
 public:
  // Throws ConfigError for a type that is unknown or occurs twice, and if there are trajectories too.
  LivePlaces(const Config& config, const VehicleModels& vehicles, const Scene& scene);

  // A track per place, TYPE.NUMBER, of one sample: the middle of the scene, where nobody is present. File coordinates.
  Trajectories tracks() const;
  const std::vector<LiveType>& types() const { return types_; }
  const LiveBounds& bounds() const { return bounds_; }  // file coordinates

  // The vehicles of a frame in their places: those of the last frame keep theirs, others take the first free one of
  // their type. Updates the traffic; throws PoseError and leaves it as it was.
  std::vector<PlacedPose> place(LiveTraffic& traffic, double time_s, std::span<const LivePose> poses) const;

  // The vehicles at a time between the last two frames, both included: those that were in both of them, on the cubic
  // with the positions and velocities of both, turning evenly; a jump stays where it was. At the time of a frame also
  // those that were in that one alone. Throws PoseError for another time, or where there are no two frames.
  std::vector<PlacedPose> between(const LiveTraffic& traffic, double time_s) const;

 private:
  const LiveType& type_of(const LivePose& pose) const;
  void check(const LivePose& pose) const;
  uint32_t free_place(const LivePose& pose, std::vector<bool>& taken) const;

  std::vector<LiveType> types_;
  LiveBounds bounds_;
  glm::dvec3 origin_m_;
  uint32_t count_ = 0;  // of places
};

}  // namespace wavetracer
