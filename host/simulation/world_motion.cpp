// SPDX-License-Identifier: Apache-2.0
#include "simulation/world_motion.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "base/times.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

// Returns for each track the largest distance of a point of its body or of an antenna on it from its origin.
std::vector<double> reaches(const World& world) {
  const Fleet& fleet = world.fleet;
  std::vector<double> out(fleet.trajectories.tracks.size(), 0);
  for (size_t i = 0; i < fleet.track_of_instance.size(); ++i) {
    const Scene& model = fleet.models[fleet.instances[i].model];
    double& reach = out[fleet.track_of_instance[i]];
    for (const glm::dvec3& p : model.vertices) reach = std::max(reach, glm::length(model.origin_m + p));
  }
  for (const EndsOfRole* role : {&world.transmitters, &world.receivers})
    for (const MountedEnd& end : role->mounted) out[end.track] = std::max(out[end.track], glm::length(end.offset_m));
  return out;
}

// The angle between two headings, by yaw and by pitch, each of which turns one way between samples.
double turned_rad(const Pose& a, const Pose& b) {
  const glm::dvec3 ahead_a = a.orientation * glm::dvec3(1, 0, 0), ahead_b = b.orientation * glm::dvec3(1, 0, 0);
  const double yaw = std::atan2(ahead_b.y, ahead_b.x) - std::atan2(ahead_a.y, ahead_a.x);
  const double pitch = std::asin(std::clamp(ahead_b.z, -1.0, 1.0)) - std::asin(std::clamp(ahead_a.z, -1.0, 1.0));
  return std::abs(std::remainder(yaw, 2 * std::numbers::pi)) + std::abs(pitch);
}

// The motion between two times with no sample between them.
double moved_m(const Pose& a, const Pose& b, double duration_s, double reach_m) {
  const glm::dvec3 first = duration_s / 3 * a.velocity_m_s;
  const glm::dvec3 last = b.position_m - a.position_m, third = last - duration_s / 3 * b.velocity_m_s;
  return std::max({glm::length(first), glm::length(third), glm::length(last)}) + turned_rad(a, b) * reach_m;
}

double track_motion_m(const Track& track, double from_s, double to_s, double reach_m) {
  std::vector<double> times{from_s};
  const auto [low, high] = std::minmax(from_s, to_s);
  for (const Sample& sample : track.samples)
    if (sample.time_s > low && sample.time_s < high) times.push_back(sample.time_s);
  times.push_back(to_s);
  if (from_s > to_s) std::reverse(times.begin() + 1, times.end() - 1);
  double sum = 0;
  size_t absent = 0;
  for (const double time : times) absent += !pose_at(track, time).has_value();
  if (absent == times.size()) return 0;
  if (absent > 0) return unbounded;
  for (const uint32_t first : track.segments)
    if (const double time = track.samples[first].time_s; time > low && time <= high + time_tolerance_s(high))
      return unbounded;
  for (size_t k = 1; k < times.size(); ++k)
    sum += moved_m(*pose_at(track, times[k - 1]), *pose_at(track, times[k]), times[k] - times[k - 1], reach_m);
  return sum;
}

}  // namespace

double motion_bound_m(const World& world, double from_s, double to_s) {
  if (world.ground.ground)
    throw ConfigError(
        "a [[mount]] has its height above the ground, so nothing bounds how far it moves: give its height above the "
        "vehicle instead");
  const std::vector<double> reach = reaches(world);
  double out = 0;
  for (size_t k = 0; k < reach.size(); ++k)
    out = std::max(out, track_motion_m(world.fleet.trajectories.tracks[k], from_s, to_s, reach[k]));
  return out;
}

}  // namespace wavetracer
