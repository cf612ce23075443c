// SPDX-License-Identifier: Apache-2.0
// The one place that limits positions, whoever gave them: configuration, trajectories, grids.
// Samples are looked at before curves between them, which could not be computed of infinite ones.
#include "simulation/world_reach.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

#include "base/times.hpp"
#include "simulation/world_trajectories.hpp"

namespace wavetracer {
namespace {

// The largest coordinate; NaN where one is.
double farthest(const glm::dvec3& p) {
  double out = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(p[axis]) <= out) && !std::isnan(out)) out = std::abs(p[axis]);
  return out;
}

constexpr const char* check_trajectories = "check trajectories.offset_m and trajectories.scale";

class Reach {
 public:
  explicit Reach(const glm::dvec3& origin_m) : origin_m_(origin_m) {}

  // who: an end as messages name it, `transmitter "rsu"`.
  void add_end(const std::string& who, const glm::dvec3& position_m);
  // Adds a vehicle with all that is on it, which is radius_m from it at most.
  void add_track(const Track& track, double radius_m);
  void add_box(const glm::dvec3& lower_m, const glm::dvec3& upper_m, double radius_m);

  // No coordinate is larger.
  double metres() const { return reach_m_; }

 private:
  std::string too_far(const std::string& who, const glm::dvec3& position_m, double distance_m) const;

  glm::dvec3 origin_m_;
  double reach_m_ = 0;
};

std::string Reach::too_far(const std::string& who, const glm::dvec3& position_m, double distance_m) const {
  const glm::dvec3 p = origin_m_ + position_m;
  return fmt::format(
      "{} is at [{:g}, {:g}, {:g}] m, {:.4g} km from the middle of the scene; the limit is {:g} km, because "
      "rays are traced in float32",
      who, p.x, p.y, p.z, distance_m / 1000, farthest_m / 1000);
}

void Reach::add_end(const std::string& who, const glm::dvec3& position_m) {
  const double distance_m = farthest(position_m);
  if (!(distance_m <= farthest_m)) throw ConfigError(too_far(who, position_m, distance_m) + ": check its position");
  reach_m_ = std::max(reach_m_, distance_m);
}

void Reach::add_track(const Track& track, double radius_m) {
  const std::string who = fmt::format("vehicle \"{}\"", track.id);
  for (const Sample& sample : track.samples)
    if (const double distance_m = farthest(sample.position_m); !(distance_m <= farthest_m))
      throw InputError(fmt::format(
          "{}: {}", too_far(fmt::format("{} at {} s", who, time_text(sample.time_s)), sample.position_m, distance_m),
          check_trajectories));
  const Bounds bounds = bounds_of(track);
  const double distance_m = std::max(farthest(bounds.lower), farthest(bounds.upper));
  if (!(distance_m <= farthest_m))
    throw InputError(
        fmt::format("{}: between two samples its speed takes it {:.4g} km away from the middle of the scene; "
                    "the limit is {:g} km: check the speeds, which are in m/s",
                    who, distance_m / 1000, farthest_m / 1000));
  if (!(radius_m <= farthest_m))
    throw ConfigError(
        fmt::format("{}: an antenna on it, or a corner of its body, is {:.4g} km away from it; the limit is "
                    "{:g} km: check mount.offset_m and the [[vehicle_type]]",
                    who, radius_m / 1000, farthest_m / 1000));
  add_box(bounds.lower, bounds.upper, radius_m);
}

void Reach::add_box(const glm::dvec3& lower_m, const glm::dvec3& upper_m, double radius_m) {
  reach_m_ = std::max({reach_m_, farthest(lower_m) + radius_m, farthest(upper_m) + radius_m});
}

// Returns the largest distance of the ground below an antenna from its vehicle.
double from_ground_m(const MountedEnd& end, const Trajectories& trajectories, const Scene& scene) {
  if (!end.above_ground) return 0;
  double out = 0;
  for (const Sample& sample : trajectories.tracks[end.track].samples)
    out = std::max({out, std::abs(sample.position_m.z - scene.lower.z), std::abs(sample.position_m.z - scene.upper.z)});
  return out;
}

// A bound of the distance of a body's corners from the middle of its footprint.
double radius_of(const Scene& model) {
  return glm::length(glm::max(glm::abs(model.origin_m + model.lower), glm::abs(model.origin_m + model.upper)));
}

// Returns the largest distance of antennas, points of targets and corners of the body from each vehicle, by track.
std::vector<double> radii_m(const Fleet& fleet, const WorldEnds& ends, const Targets& targets, const Scene& scene) {
  std::vector<double> out(fleet.trajectories.tracks.size(), 0);
  for (const auto* role : {&ends.transmitters, &ends.receivers})
    for (const MountedEnd& end : role->mounted)
      out[end.track] =
          std::max(out[end.track], glm::length(end.offset_m) + from_ground_m(end, fleet.trajectories, scene));
  for (const TargetPoint& point : targets.points)
    if (const auto track = targets.all[point.target].track) out[*track] = std::max(out[*track], point.reach_m());
  for (size_t i = 0; i < fleet.track_of_instance.size(); ++i) {
    double& radius_m = out[fleet.track_of_instance[i]];
    radius_m = std::max(radius_m, radius_of(fleet.models[fleet.instances[i].model]));
  }
  return out;
}

}  // namespace

double reach_of(const Fleet& fleet, const WorldEnds& ends, const Targets& targets,
                const std::optional<LivePlaces>& live, const Scene& scene) {
  Reach reach(scene.origin_m);
  for (const auto& [role, word] : {std::pair{&ends.transmitters, "transmitter"}, {&ends.receivers, "receiver"}})
    for (size_t i = 0; i < role->standing.size(); ++i)
      reach.add_end(fmt::format("{} \"{}\"", word, role->ends[i].name), role->standing[i].position_m);
  for (const TargetPoint& point : targets.points) {
    const Target& target = targets.all[point.target];
    if (target.track) continue;
    const glm::dvec3 at = position_at(target.pose, point.part ? point.part->pivot_m : point.arm_m);
    reach.add_end(fmt::format("target \"{}\"", target.name), at);
    if (point.part) reach.add_box(at, at, point.part->arm_m);
  }
  for (const StandingBody& body : fleet.standing) {
    const glm::dvec3 far_m(radius_of(fleet.models[body.model]));
    const std::string name = fleet.instances[fleet.instance_of_standing(&body - fleet.standing.data())].id;
    reach.add_end(fmt::format("a corner of target \"{}\"", name), body.pose.position_m + far_m);
    reach.add_box(body.pose.position_m, body.pose.position_m, far_m.x);
  }
  const std::vector<double> radius_m = radii_m(fleet, ends, targets, scene);
  for (size_t k = 0; k < radius_m.size(); ++k) {
    if (live)
      reach.add_box(live->bounds().lower_m - scene.origin_m, live->bounds().upper_m - scene.origin_m, radius_m[k]);
    else
      reach.add_track(fleet.trajectories.tracks[k], radius_m[k]);
  }
  return reach.metres();
}

}  // namespace wavetracer
