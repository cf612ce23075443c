// SPDX-License-Identifier: Apache-2.0
// Bodies are numbered in the order of the tracks, so that a number means the same vehicle in all frames.
#include "simulation/world_fleet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "simulation/world_trajectories.hpp"
#include "wavetracer/device/records.h"
#include "wavetracer/error.hpp"

namespace wavetracer {

Fleet make_fleet(Trajectories trajectories, VehicleModels vehicles, const Scene& scene) {
  Fleet out;
  uint64_t next_surface = scene.surfaces.size(), next_wedge = scene.wedges.size();
  for (uint32_t k = 0; k < trajectories.tracks.size(); ++k) {
    const Track& track = trajectories.tracks[k];
    const VehicleType& type = trajectories.types[track.type];
    const std::optional<uint32_t> model = vehicles.model_of(type, track.id);
    out.instance_of_track.push_back(model ? static_cast<uint32_t>(out.instances.size()) : no_instance);
    if (!model) continue;
    out.instances.push_back(
        {track.id, type.name, *model, static_cast<uint32_t>(next_surface), static_cast<uint32_t>(next_wedge)});
    out.track_of_instance.push_back(k);
    next_surface += vehicles.models()[*model].surfaces.size();
    next_wedge += vehicles.models()[*model].wedges.size();
    if (next_surface > ~WT_STEP_KIND || next_wedge >= 1u << 27)
      throw RuntimeError(
          fmt::format("the scene and {} vehicles have more than 2^29 surfaces or 2^27 edges: use models "
                      "with fewer faces, or shorter trajectories",
                      out.instances.size()));
  }
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
