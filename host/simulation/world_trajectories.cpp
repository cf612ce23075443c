// SPDX-License-Identifier: Apache-2.0
// Reads, generates and joins trajectories.
// Assumes that waypoints and generated traffic are in coordinates of the scene file already.
#include "simulation/world_trajectories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <set>

#include "motion/parked.hpp"
#include "motion/read.hpp"
#include "motion/track_motion.hpp"
#include "scene/city_traffic.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

GroundHeight ground_of(PlaceFinder& places) {
  return [&places](const glm::dvec2& place_m) { return places.ground_m(place_m); };
}

Trajectories read(const TrajectoriesConfig& config, const VehicleModels& vehicles, PlaceFinder& places) {
  TrajectoryOptions options;
  options.offset_m = {config.offset_m[0], config.offset_m[1], config.offset_m[2]};
  options.scale = config.scale;
  options.persons = config.persons;
  options.containers = config.containers;
  options.types = vehicles.given_types();
  options.default_type = vehicles.default_type();
  options.above_ground = from_ground(config.above);
  options.ground = ground_of(places);
  if (places.has_georeference())
    options.from_degrees = [&](const glm::dvec2& degrees) { return places.from_degrees(degrees, config.file); };
  return read_trajectories(config.file, options);
}

Trajectories generate(const std::string& text, const VehicleModels& vehicles) {
  Trajectories out = generate_traffic(text);
  for (VehicleType& type : out.types) {
    const std::vector<VehicleType>& given = vehicles.given_types();
    const auto found = std::find_if(given.begin(), given.end(), [&](const auto& t) { return t.name == type.name; });
    if (found != given.end()) type = *found;
  }
  return out;
}

std::vector<Waypoint> waypoints_of(const TrackConfig& track, PlaceFinder& places) {
  std::vector<Waypoint> out;
  for (const auto& [time_s, x, y, z] : track.waypoints) out.push_back({time_s, {x, y, z}});
  for (const auto& [time_s, latitude, longitude, height_m] : track.waypoints_wgs84) {
    const glm::dvec2 place_m =
        places.from_degrees({longitude, latitude}, fmt::format("[[track]] \"{}\", waypoints_wgs84", track.id));
    out.push_back({time_s, {place_m.x, place_m.y, height_m}});
  }
  return out;
}

Trajectories connect(const std::vector<TrackConfig>& tracks, const VehicleModels& vehicles, PlaceFinder& places) {
  std::vector<WaypointTrack> out;
  for (const TrackConfig& track : tracks) {
    std::optional<VehicleType> type = vehicles.find_type(track.type);
    if (!type)
      throw ConfigError(
          fmt::format("[[track]] \"{}\": type = \"{}\" is neither a [[vehicle_type]] nor a vehicle class "
                      "of SUMO: add a [[vehicle_type]] with its length_m, width_m and height_m",
                      track.id, track.type));
    type->name = track.type;
    const bool above_ground = from_ground(track.above) || !track.waypoints_wgs84.empty();
    out.push_back({track.id, *type, waypoints_of(track, places), above_ground});
  }
  return connect_waypoints(out, ground_of(places));
}

std::vector<ParkedPlace> places_of(const ParkedConfig& parked) {
  if (!parked.file.empty()) return read_parked(parked.file);
  std::vector<ParkedPlace> out;
  for (const auto& [x, y, z, yaw_deg] : parked.places) out.push_back({{x, y, z}, yaw_deg, ""});
  return out;
}

// Standing from the first frame to the last.
Track standing(std::string id, uint32_t type, const ParkedPlace& place, double first_s, double last_s) {
  Track out{std::move(id), type, {}, {0}};
  Sample sample{.position_m = place.position_m,
                .yaw_rad = glm::radians(std::remainder(place.yaw_deg, 360.0)),
                .pitch_rad = 0,
                .speed_m_s = 0,
                .velocity_m_s = glm::dvec3(0)};
  for (const double time_s : {first_s, last_s}) {
    if (!out.samples.empty() && !(time_s > first_s)) break;
    sample.time_s = time_s;
    out.samples.push_back(sample);
  }
  return out;
}

// They say nothing of the times of a drive: those are the others', or those of [time] where all are parked.
void park(Trajectories& to, const Config& config, const VehicleModels& vehicles) {
  if (config.parked.empty()) return;
  const bool alone = to.tracks.empty();
  const double start_s = config.time.start_s.value_or(alone ? 0 : to.first_time_s);
  const double end_s = config.time.end_s.value_or(alone ? start_s : to.last_time_s);
  const double first_s = alone ? start_s : std::min(start_s, to.first_time_s);
  const double last_s = alone ? end_s : std::max(end_s, to.last_time_s);
  std::set<std::string> ids;
  for (const Track& track : to.tracks) ids.insert(track.id);
  for (const ParkedConfig& parked : config.parked) {
    const std::vector<ParkedPlace> places = places_of(parked);
    for (size_t i = 0; i < places.size(); ++i) {
      const std::string& name = places[i].type.empty() ? parked.type : places[i].type;
      std::optional<VehicleType> type = vehicles.find_type(name);
      if (!type)
        throw ConfigError(
            fmt::format("[[parked]] \"{}\", place {}: the type \"{}\" is neither a [[vehicle_type]] nor a vehicle "
                        "class of SUMO: add a [[vehicle_type]] with its length_m, width_m and height_m",
                        parked.name, i, name));
      type->name = name;
      auto same = std::ranges::find(to.types, *type);
      if (same == to.types.end()) same = to.types.insert(same, *type);
      const std::string id = fmt::format("{}/{}", parked.name, i);
      if (!ids.insert(id).second)
        throw ConfigError(fmt::format(
            "[[parked]] \"{}\": the trajectories have a vehicle \"{}\" too: choose another name", parked.name, id));
      to.tracks.push_back(standing(id, static_cast<uint32_t>(same - to.types.begin()), places[i], first_s, last_s));
      to.tracks.back().mounts = parked.mounts;
    }
  }
  if (alone) to.first_time_s = first_s, to.last_time_s = last_s;
}

// Waypoints lie farther apart than samples, so the step stays that of `to`, where it has one.
void join(Trajectories& to, Trajectories more) {
  const double step_s = to.step_s > 0 ? to.step_s : more.step_s;
  std::set<std::string_view> ids;
  for (const Track& track : to.tracks) ids.insert(track.id);
  for (const Track& track : more.tracks)
    if (ids.contains(track.id))
      throw ConfigError(
          fmt::format("[[track]] \"{0}\": the trajectories have a vehicle \"{0}\" too: choose another id", track.id));
  const auto first_type = static_cast<uint32_t>(to.types.size());
  to.types.insert(to.types.end(), more.types.begin(), more.types.end());
  for (Track& track : more.tracks) {
    track.type += first_type;
    to.tracks.push_back(std::move(track));
  }
  to.warnings.insert(to.warnings.end(), more.warnings.begin(), more.warnings.end());
  set_order(to);
  to.step_s = step_s;
}

}  // namespace

Trajectories load_trajectories(const Config& config, const VehicleModels& vehicles, PlaceFinder& places) {
  Trajectories out;
  if (!config.trajectories.file.empty()) out = read(config.trajectories, vehicles, places);
  if (!config.trajectories.generate.empty()) out = generate(config.trajectories.generate, vehicles);
  if (!config.tracks.empty()) join(out, connect(config.tracks, vehicles, places));
  park(out, config, vehicles);
  return out;
}

Bounds bounds_of(const Track& track) {
  Bounds out{track.samples.front().position_m, track.samples.front().position_m};
  const auto add = [&](const Sample& s, const glm::dvec3& margin_m) {
    out.lower = glm::min(out.lower, s.position_m - margin_m);
    out.upper = glm::max(out.upper, s.position_m + margin_m);
  };
  for (size_t k = 0; k < track.samples.size(); ++k) {
    const Sample& b = track.samples[k];
    glm::dvec3 margin_m(0);
    if (!std::binary_search(track.segments.begin(), track.segments.end(), static_cast<uint32_t>(k))) {
      // A cubic between two samples leaves their box by the terms of its velocities, each at most 4/27 of the duration.
      const Sample& a = track.samples[k - 1];
      margin_m = 4.0 / 27 * (b.time_s - a.time_s) * (glm::abs(a.velocity_m_s) + glm::abs(b.velocity_m_s));
      add(a, margin_m);
    }
    add(b, margin_m);
  }
  return out;
}

}  // namespace wavetracer
