// Reads, generates and joins trajectories.
// Assumes that waypoints and generated traffic are in coordinates of the scene file already.
#include "simulation/world_trajectories.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <set>

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
  options.above_ground = config.above == "ground";
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
    const bool above_ground = track.above == "ground" || !track.waypoints_wgs84.empty();
    out.push_back({track.id, *type, waypoints_of(track, places), above_ground});
  }
  return connect_waypoints(out, ground_of(places));
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
