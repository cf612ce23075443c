// SPDX-License-Identifier: Apache-2.0
// Bodies are numbered in the order of the tracks, so that a number means the same vehicle in all frames.
#include "simulation/world_fleet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "simulation/world_trajectories.hpp"
#include "wavetracer/device/records.h"
#include "wavetracer/error.hpp"

namespace wavetracer {

namespace {

// Adds an instance, and numbers its surfaces and wedges behind those before it.
class InstanceNumbers {
 public:
  InstanceNumbers(const Scene& scene, const VehicleModels& vehicles)
      : vehicles_(vehicles), next_surface_(scene.surfaces.size()), next_wedge_(scene.wedges.size()) {}

  void add(Fleet& to, const std::string& id, const std::string& type, uint32_t model) {
    to.instances.push_back({id, type, model, static_cast<uint32_t>(next_surface_), static_cast<uint32_t>(next_wedge_)});
    next_surface_ += vehicles_.models()[model].surfaces.size();
    next_wedge_ += vehicles_.models()[model].wedges.size();
    if (next_surface_ > ~WT_STEP_KIND || next_wedge_ >= 1u << 27)
      throw RuntimeError(
          fmt::format("the scene and {} vehicles have more than 2^29 surfaces or 2^27 edges: use models "
                      "with fewer faces, or shorter trajectories",
                      to.instances.size()));
  }

 private:
  const VehicleModels& vehicles_;
  uint64_t next_surface_, next_wedge_;
};

}  // namespace

Fleet make_fleet(Trajectories trajectories, std::vector<StandingBody> standing, const Config& config,
                 VehicleModels vehicles, const Scene& scene) {
  Fleet out;
  InstanceNumbers numbers(scene, vehicles);
  for (uint32_t k = 0; k < trajectories.tracks.size(); ++k) {
    const Track& track = trajectories.tracks[k];
    const VehicleType& type = trajectories.types[track.type];
    const std::optional<uint32_t> model = vehicles.model_of(type, track.id);
    out.instance_of_track.push_back(model ? static_cast<uint32_t>(out.instances.size()) : no_instance);
    if (!model) continue;
    numbers.add(out, track.id, type.name, *model);
    out.track_of_instance.push_back(k);
  }
  for (const StandingBody& body : standing) numbers.add(out, config.targets[body.target].name, body.type, body.model);
  out.standing = std::move(standing);
  out.trajectories = std::move(trajectories);
  out.models = std::move(vehicles).take_models();
  return out;
}

VehicleState vehicle_at(const Track& track, double time_s) {
  if (const auto pose = pose_at(track, time_s)) return {*pose, true};
  const auto later = std::upper_bound(track.samples.begin(), track.samples.end(), time_s,
                                      [](double time, const Sample& s) { return time < s.time_s; });
  const Sample& last = later == track.samples.begin() ? *later : *(later - 1);
  return {*pose_at(track, last.time_s), false};
}

glm::dvec3 position_at(const Pose& pose, const glm::dvec3& arm_m) { return pose.position_m + pose.orientation * arm_m; }

glm::dvec3 velocity_at(const Pose& pose, const glm::dvec3& arm_m) {
  return pose.velocity_m_s + glm::cross(pose.angular_velocity_rad_s, pose.orientation * arm_m);
}

Placement placement_of(const Scene& model, const VehicleState& vehicle) {
  const Pose& pose = vehicle.pose;
  return {position_at(pose, model.origin_m), glm::mat3_cast(pose.orientation), velocity_at(pose, model.origin_m),
          pose.angular_velocity_rad_s, vehicle.present};
}

std::vector<std::string> outside_warning(const Trajectories& trajectories, const Scene& scene) {
  size_t outside = 0;
  for (const Track& track : trajectories.tracks) {
    const Bounds b = bounds_of(track);
    outside += b.lower.x > scene.upper.x || b.upper.x < scene.lower.x || b.lower.y > scene.upper.y ||
               b.upper.y < scene.lower.y;
  }
  if (outside == 0) return {};
  return {
      fmt::format("{} of {} vehicles are never inside the scene: check trajectories.offset_m and trajectories.scale",
                  outside, trajectories.tracks.size())};
}

}  // namespace wavetracer
