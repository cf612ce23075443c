// SPDX-License-Identifier: Apache-2.0
// The world of a configuration, made once, step by step; then its state at any instant.
// Tracks are recentred as they are loaded, so that everything here is in coordinates of the recentred scene.
#include "simulation/world.hpp"

#include <algorithm>

#include "simulation/place_finder.hpp"
#include "simulation/receiver_grid.hpp"
#include "simulation/world_clock.hpp"
#include "simulation/world_models.hpp"
#include "simulation/world_reach.hpp"
#include "simulation/world_trajectories.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

Trajectories recentred(Trajectories trajectories, const glm::dvec3& origin_m) {
  for (Track& track : trajectories.tracks)
    for (Sample& sample : track.samples) sample.position_m -= origin_m;
  return trajectories;
}

// Tells whether frames follow from tracks; otherwise there is one frame, at 0 s.
bool drives(const Fleet& fleet, const std::optional<LivePlaces>& live) {
  return !live && !fleet.trajectories.tracks.empty();
}

std::vector<std::string> warnings_of(const Config& config, const Scene& scene, const Fleet& fleet,
                                     const std::optional<LivePlaces>& live, const FrameClock& clock) {
  std::vector<std::string> out = fleet.trajectories.warnings;
  const auto add = [&](const std::vector<std::string>& more) { out.insert(out.end(), more.begin(), more.end()); };
  add(model_warnings(fleet.models, scene));
  if (drives(fleet, live)) add(empty_frames_warning(config.time, fleet.trajectories, clock));
  if (!live) add(outside_warning(fleet.trajectories, scene));
  return out;
}

// vehicles: the state of each track.
WorldState world_at(const World& world, double time_s, const std::vector<VehicleState>& vehicles) {
  WorldState out;
  out.time_s = time_s;
  const Fleet& fleet = world.fleet;
  for (size_t i = 0; i < fleet.track_of_instance.size(); ++i)
    out.instances.push_back(placement_of(fleet.models[fleet.instances[i].model], vehicles[fleet.track_of_instance[i]]));
  for (const StandingBody& body : fleet.standing)
    out.instances.push_back(placement_of(fleet.models[body.model], {body.pose, true}));
  out.transmitters = ends_at(world.transmitters, fleet, world.ground, vehicles);
  out.receivers = ends_at(world.receivers, fleet, world.ground, vehicles);
  out.targets = targets_at(world.targets, fleet, vehicles, time_s);
  out.links = world.links(out.transmitters, out.receivers);
  return out;
}

// ids: the vehicles of all tracks, empty where there is none.
std::vector<std::string> names_of(const EndsOfRole& role, const Fleet& fleet, const std::vector<std::string>& ids) {
  std::vector<std::string> out;
  for (size_t i = 0; i < role.ends.size(); ++i) {
    const std::string& name = role.ends[i].name;
    if (i < role.standing.size()) {
      out.push_back(name);
      continue;
    }
    const uint32_t track = role.mounted[i - role.standing.size()].track;
    const std::string& place = fleet.trajectories.tracks[track].id;  // the name is PLACE/MOUNT
    out.push_back(ids[track].empty() ? "" : ids[track] + name.substr(place.size()));
  }
  return out;
}

}  // namespace

World make_world(const Config& config, const Scene& scene) {
  VehicleModels vehicles(config);
  std::optional<LivePlaces> live;
  if (!config.live_vehicles.empty()) live.emplace(config, vehicles, scene);
  PlaceFinder places(config, scene);
  GroundBelow ground = ground_below(config.mounts, places, scene.origin_m);
  Trajectories trajectories =
      recentred(live ? live->tracks() : load_trajectories(config, vehicles, places), scene.origin_m);
  WorldEnds standing{standing_ends(standing_transmitters(config, places), scene.origin_m),
                     standing_ends(standing_receivers(config, scene, places), scene.origin_m)};
  std::vector<StandingBody> standing_bodies_of_targets = standing_bodies(config, vehicles, scene.origin_m);
  Fleet fleet =
      make_fleet(std::move(trajectories), std::move(standing_bodies_of_targets), config, std::move(vehicles), scene);
  WorldEnds ends = with_mounts(std::move(standing), config.mounts, fleet, ground, !live);
  Targets targets = make_targets(config, fleet, ends, scene.origin_m, !live);
  LinkRules links = link_rules(config.links, ends);
  TwinEnds twins = find_twins(ends);
  const FrameClock clock = drives(fleet, live) ? make_clock(config.time, fleet.trajectories) : FrameClock(0, 0, 1);
  const double reach_m = reach_of(fleet, ends, targets, live, scene);
  std::vector<std::string> warnings = warnings_of(config, scene, fleet, live, clock);
  World out{.live = std::move(live),
            .fleet = std::move(fleet),
            .ground = std::move(ground),
            .transmitters = std::move(ends.transmitters),
            .receivers = std::move(ends.receivers),
            .targets = std::move(targets),
            .twins = std::move(twins),
            .links = std::move(links),
            .clock = clock,
            .reach_m = reach_m,
            .warnings = std::move(warnings)};
  if (!out.live && out.fleet.trajectories.tracks.empty()) out.resting = world_at(out, 0, {});
  return out;
}

WorldState World::state(uint64_t frame) const {
  return at(clock.time_s(frame));  // throws for a frame that there is not
}

WorldState World::at(double time_s) const {
  if (resting) return *resting;
  std::vector<VehicleState> vehicles;
  vehicles.reserve(fleet.trajectories.tracks.size());
  for (const Track& track : fleet.trajectories.tracks) vehicles.push_back(vehicle_at(track, time_s));
  if (live)
    for (VehicleState& vehicle : vehicles) vehicle.present = false;
  return world_at(*this, time_s, vehicles);
}

WorldState World::state(double time_s, const std::vector<PlacedPose>& placed) const {
  std::vector<VehicleState> vehicles;
  vehicles.reserve(fleet.trajectories.tracks.size());
  for (const Track& track : fleet.trajectories.tracks) vehicles.push_back({*pose_at(track, 0), false});
  for (const PlacedPose& at : placed) vehicles[at.place] = {at.pose, true, at.travelled};
  WorldState out = world_at(*this, time_s, vehicles);
  out.arrivals = std::ranges::any_of(placed, &PlacedPose::arrives);
  return out;
}

LiveNames World::names(const std::vector<PlacedPose>& placed) const {
  std::vector<std::string> ids(fleet.trajectories.tracks.size());
  for (const PlacedPose& at : placed) ids[at.place] = at.id;
  LiveNames out{names_of(transmitters, fleet, ids), names_of(receivers, fleet, ids), {}};
  for (const uint32_t track : fleet.track_of_instance) out.instances.push_back(ids[track]);
  for (size_t i = 0; i < fleet.standing.size(); ++i)
    out.instances.push_back(fleet.instances[fleet.instance_of_standing(i)].id);
  return out;
}

const LivePlaces& World::live_places() const {
  if (!live)
    throw ConfigError(
        "there is no [[live_vehicle]] table: a live world says with it how many vehicles of each type there may be");
  return *live;
}

}  // namespace wavetracer
