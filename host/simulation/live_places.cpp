// SPDX-License-Identifier: Apache-2.0
// Places of vehicles, and their velocities. All errors in poses are found before the traffic changes. Poses must be of
// one instant and from one source.
#include "simulation/live_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "base/spelling.hpp"
#include "base/times.hpp"
#include "simulation/live_motion.hpp"
#include "simulation/name_pattern.hpp"
#include "wavetracer/names.hpp"

namespace wavetracer {
namespace {

constexpr double most_m_s = 1000, most_rad_s = 100;  // limits of given velocities
constexpr double most_travelled_m = 1e9;
constexpr double unit_tolerance = 1e-3;  // tolerance of an orientation's length

// The way by which parts of the vehicle turn in this pose.
Travelled travelled_of(const LiveTraffic::Vehicle& vehicle, const Pose& pose) {
  Travelled out = velocities_of(pose);
  out.way_m = vehicle.way_m;
  out.turn_rad = vehicle.turn_rad;
  return out;
}

bool within(const glm::dvec3& v, double most) {
  return std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most;  // false for NaN
}

}  // namespace

LivePlaces::LivePlaces(const Config& config, const VehicleModels& vehicles, const Scene& scene)
    : bounds_{scene.origin_m + scene.lower - config.live.margin_m, scene.origin_m + scene.upper + config.live.margin_m},
      origin_m_(scene.origin_m) {
  if (!config.trajectories.file.empty() || !config.trajectories.generate.empty() || !config.tracks.empty() ||
      !config.parked.empty())
    throw ConfigError(
        "[[live_vehicle]] and trajectories exclude each other: with live vehicles all poses come from the "
        "client; leave out trajectories.file, trajectories.generate, every [[track]] and every [[parked]]");
  for (const LiveVehicleConfig& row : config.live_vehicles) {
    if (std::ranges::any_of(types_, [&](const LiveType& type) { return type.name == row.type; }))
      throw ConfigError(fmt::format(
          "[[live_vehicle]] type = \"{}\" is listed twice: make one table of the two, with the sum of their counts",
          row.type));
    const std::optional<VehicleType> known = vehicles.find_type(row.type);
    if (!known)
      throw ConfigError(
          fmt::format("[[live_vehicle]] type = \"{}\" is neither a [[vehicle_type]] nor a vehicle class of "
                      "SUMO: add a [[vehicle_type]] with its length_m, width_m and height_m",
                      row.type));
    LiveType& type = types_.emplace_back(
        LiveType{row.type, known->length_m, known->width_m, known->height_m, count_, row.count, {}});
    for (const MountConfig& mount : config.mounts)
      if (matches(mount.on, row.type)) type.mounts.push_back(mount);
    count_ += row.count;
  }
}

Trajectories LivePlaces::tracks() const {
  Trajectories out;
  const glm::dvec3 middle_m = (bounds_.lower_m + bounds_.upper_m) / 2.0;
  const Sample parked{.position_m = middle_m, .yaw_rad = 0, .pitch_rad = 0, .speed_m_s = 0, .velocity_m_s{0, 0, 0}};
  for (const LiveType& type : types_) {
    const auto index = static_cast<uint32_t>(out.types.size());
    out.types.push_back({type.name, type.length_m, type.width_m, type.height_m});
    for (uint32_t k = 0; k < type.count; ++k)
      out.tracks.push_back({fmt::format("{}.{}", type.name, k), index, {parked}, {0}});
  }
  return out;
}

const LiveType& LivePlaces::type_of(const LivePose& pose) const {
  const auto found = std::ranges::find(types_, pose.type, &LiveType::name);
  if (found != types_.end()) return *found;
  std::vector<std::string> names;
  for (const LiveType& type : types_) names.push_back(type.name);
  throw PoseError("unknown_type", fmt::format("vehicle \"{}\": \"{}\" is not the type of a [[live_vehicle]]{}", pose.id,
                                              pose.type, spelling_hint(pose.type, names)));
}

void LivePlaces::check(const LivePose& pose) const {
  const auto refuse = [&](const char* code, const std::string& what) {
    throw PoseError(code, fmt::format("vehicle \"{}\": {}", pose.id, what));
  };
  if (has_control_character(pose.id)) refuse("bad_value", "its id has control characters");
  const glm::dvec3 &p = pose.position_m, &lower = bounds_.lower_m, &upper = bounds_.upper_m;
  for (int axis = 0; axis < 3; ++axis)
    if (!(p[axis] >= lower[axis] && p[axis] <= upper[axis]))
      refuse(
          "out_of_bounds",
          fmt::format("position_m [{}, {}, {}] is outside of [{}, {}, {}] to [{}, {}, {}], the scene and live.margin_m "
                      "around it",
                      p.x, p.y, p.z, lower.x, lower.y, lower.z, upper.x, upper.y, upper.z));
  if (!(std::abs(glm::length(pose.orientation) - 1) <= unit_tolerance))
    refuse("bad_value", fmt::format("orientation has length {}, not 1", glm::length(pose.orientation)));
  if (!within(pose.velocity_m_s.value_or(glm::dvec3(0)), most_m_s))
    refuse("bad_value", fmt::format("a component of velocity_m_s is beyond {} m/s", most_m_s));
  if (!within(pose.angular_velocity_rad_s.value_or(glm::dvec3(0)), most_rad_s))
    refuse("bad_value", fmt::format("a component of angular_velocity_rad_s is beyond {} rad/s", most_rad_s));
  if (!(std::abs(pose.travelled_m.value_or(0)) <= most_travelled_m))
    refuse("bad_value", fmt::format("travelled_m is {}, beyond {} m", *pose.travelled_m, most_travelled_m));
}

// Finds the first free place of the vehicle's type, and takes it.
uint32_t LivePlaces::free_place(const LivePose& pose, std::vector<bool>& taken) const {
  const LiveType& type = type_of(pose);
  const auto first = taken.begin() + type.first_place, end = first + type.count, free = std::find(first, end, false);
  if (free == end)
    throw PoseError("no_place", fmt::format("vehicle \"{}\": all {} places of type \"{}\" are taken: raise the count "
                                            "of its [[live_vehicle]]",
                                            pose.id, type.count, pose.type));
  *free = true;
  return static_cast<uint32_t>(free - taken.begin());
}

std::vector<PlacedPose> LivePlaces::place(LiveTraffic& traffic, double time_s, std::span<const LivePose> poses) const {
  if (!std::isfinite(time_s)) throw PoseError("bad_value", "time_s is not finite");
  std::set<std::string_view> ids;
  std::vector<bool> taken(count_, false);
  for (const LivePose& pose : poses) {
    if (!ids.insert(pose.id).second)
      throw PoseError("duplicate_id", fmt::format("vehicle \"{}\" occurs twice in one frame", pose.id));
    check(pose);
    const LiveType& type = type_of(pose);
    const auto known = traffic.vehicles.find(pose.id);
    if (known == traffic.vehicles.end()) continue;
    const uint32_t place = known->second.place;
    if (place < type.first_place || place >= type.first_place + type.count)
      throw PoseError("type_changed", fmt::format("vehicle \"{}\" was of another type in the last frame, now it is of "
                                                  "\"{}\": give the new one another id, or leave it out for a frame",
                                                  pose.id, pose.type));
    taken[place] = true;
  }

  const double passed_s = time_s - traffic.time_s;
  LiveTraffic next{{}, time_s, traffic.frames, {}, traffic.time_s, traffic.discovery};
  std::vector<PlacedPose> out;
  for (const LivePose& pose : poses) {
    const auto known = traffic.vehicles.find(pose.id);
    const bool stays = known != traffic.vehicles.end();
    LiveTraffic::Vehicle now{0, pose.position_m, live_unit(pose.orientation), pose.velocity_m_s};
    if (stays) {
      now.place = known->second.place;
    } else {
      now.place = free_place(pose, taken);
    }
    Pose placed{pose.position_m - origin_m_, now.orientation, glm::dvec3(0), glm::dvec3(0)};
    bool jumped = false;
    if (stays && passed_s > 0) {
      const glm::dvec3 velocity_m_s = (pose.position_m - known->second.position_m) / passed_s;
      jumped = glm::length(velocity_m_s) > live_jump_m_s;
      if (!jumped) {
        placed.velocity_m_s = velocity_m_s;
        if (!now.velocity_m_s) now.velocity_m_s = velocity_m_s;
        const glm::dvec3 turn_rad_s = live_turning(known->second.orientation, now.orientation, passed_s);
        if (within(turn_rad_s, most_rad_s)) placed.angular_velocity_rad_s = turn_rad_s;
      }
    }
    placed.velocity_m_s = pose.velocity_m_s.value_or(placed.velocity_m_s);
    placed.angular_velocity_rad_s = pose.angular_velocity_rad_s.value_or(placed.angular_velocity_rad_s);
    if (stays) {
      const Travelled gone = live_travelled(known->second, now, std::max(passed_s, 0.0), 1);
      now.way_m = gone.way_m;
      now.turn_rad = gone.turn_rad;
    }
    now.way_m.x = pose.travelled_m.value_or(now.way_m.x);
    out.push_back({now.place, placed, pose.id, !stays || jumped, travelled_of(now, placed)});
    next.vehicles.emplace(pose.id, now);
  }
  next.earlier = std::move(traffic.vehicles);
  traffic = std::move(next);
  return out;
}

std::vector<PlacedPose> LivePlaces::between(const LiveTraffic& traffic, double time_s) const {
  const double duration_s = traffic.time_s - traffic.earlier_s;
  if (traffic.frames < 2 || !(duration_s > 0))
    throw PoseError("out_of_time", "there are no two frames of poses yet, the later one after the earlier one");
  const double tolerance_s = std::min(time_tolerance_s(traffic.time_s), duration_s / 4);
  if (!(time_s >= traffic.earlier_s - tolerance_s && time_s <= traffic.time_s + tolerance_s))
    throw PoseError("out_of_time", fmt::format("time_s is {}, and the last two frames of poses are of {} and {} s",
                                               time_s, traffic.earlier_s, traffic.time_s));
  std::vector<PlacedPose> out;
  const auto alone = [&](const LiveTraffic::Vehicles& in, const LiveTraffic::Vehicles& other) {
    for (const auto& [id, vehicle] : in)
      if (!other.contains(id)) {
        out.push_back({vehicle.place,
                       {vehicle.position_m - origin_m_, vehicle.orientation,
                        vehicle.velocity_m_s.value_or(glm::dvec3(0)), glm::dvec3(0)},
                       id,
                       false,
                       {}});
        out.back().travelled = travelled_of(vehicle, out.back().pose);
      }
  };
  if (time_s <= traffic.earlier_s + tolerance_s) alone(traffic.earlier, traffic.vehicles);
  if (time_s >= traffic.time_s - tolerance_s) alone(traffic.vehicles, traffic.earlier);
  const double u = std::clamp((time_s - traffic.earlier_s) / duration_s, 0.0, 1.0);
  for (const auto& [id, to] : traffic.vehicles) {
    const auto from = traffic.earlier.find(id);
    if (from == traffic.earlier.end()) continue;
    out.push_back({to.place, live_pose(from->second, to, duration_s, u), id, false,
                   live_travelled(from->second, to, duration_s, u)});
    out.back().pose.position_m -= origin_m_;
  }
  return out;
}

}  // namespace wavetracer
