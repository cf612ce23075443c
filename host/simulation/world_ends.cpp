// SPDX-License-Identifier: Apache-2.0
// Places are compared exactly: two ends are one because their configuration says so, not because they are near.
#include "simulation/world_ends.hpp"

#include <fmt/format.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "base/spelling.hpp"
#include "radio/antenna.hpp"
#include "simulation/name_pattern.hpp"
#include "simulation/world_links.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// Returns the place of a mount on this vehicle, from the centre of the footprint.
glm::dvec3 offset_of(const MountConfig& mount, const Fleet& fleet, uint32_t track) {
  if (mount.node.empty()) return vector_of(mount.offset_m);
  const Track& vehicle = fleet.trajectories.tracks[track];
  const std::string who = fmt::format("[[mount]] \"{}\": node = \"{}\": the vehicle \"{}\" of type \"{}\"", mount.name,
                                      mount.node, vehicle.id, fleet.trajectories.types[vehicle.type].name);
  if (fleet.instance_of_track[track] == no_instance)
    throw ConfigError(who + " has no body, and so no nodes: leave node out, or choose other vehicles by on");
  const Scene& model = fleet.models[fleet.instances[fleet.instance_of_track[track]].model];
  std::vector<std::string> names;
  const SceneNode* found = nullptr;
  for (const SceneNode& node : model.nodes) {
    names.push_back(node.name);
    if (node.name != mount.node) continue;
    if (found && found->position_m != node.position_m)
      throw ConfigError(who + " has several nodes of this name in its body, " + model.file + ": rename all but one");
    found = &node;
  }
  if (!found)
    throw ConfigError(fmt::format("{} has no such node in its body, {}{}", who, model.file,
                                  names.empty() ? ", which has none" : spelling_hint(mount.node, names)));
  return model.origin_m + found->position_m + vector_of(mount.offset_m);
}

glm::dvec3 mounted_position(const MountedEnd& end, const GroundBelow& ground, const Pose& pose) {
  if (!end.above_ground) return position_at(pose, end.offset_m);
  glm::dvec3 out = position_at(pose, {end.offset_m.x, end.offset_m.y, 0});
  out.z = ground.height_m(out).value_or(pose.position_m.z) + end.offset_m.z;
  return out;
}

EndState mounted_at(const MountedEnd& end, const Fleet& fleet, const GroundBelow& ground, const VehicleState& vehicle) {
  return {.position_m = mounted_position(end, ground, vehicle.pose),
          .rotation = glm::mat3_cast(vehicle.pose.orientation) * end.rotation,
          .velocity_m_s = velocity_at(vehicle.pose, end.offset_m),
          .instance = fleet.instance_of_track[end.track],
          .present = vehicle.present};
}

// The end as it is where its vehicle first appears, in file coordinates.
RadioEnd radio_end(const MountConfig& mount, const Track& vehicle, const EndState& first, const glm::dvec3& origin_m) {
  const glm::dvec3 position_m = origin_m + first.position_m, velocity_m_s = first.velocity_m_s;
  return {.name = vehicle.id + "/" + mount.name,
          .position_m = {position_m.x, position_m.y, position_m.z},
          .antenna = mount.antenna,
          .polarization = mount.polarization,
          .orientation_deg = mount.orientation_deg,
          .velocity_m_s = {velocity_m_s.x, velocity_m_s.y, velocity_m_s.z},
          .array = mount.array};
}

void add_mounted(EndsOfRole& role, const MountConfig& mount, const Fleet& fleet, const GroundBelow& ground,
                 uint32_t track) {
  const Track& vehicle = fleet.trajectories.tracks[track];
  const MountedEnd end{track, offset_of(mount, fleet, track), rotation_of(mount.orientation_deg),
                       from_ground(mount.above)};
  const EndState first = mounted_at(end, fleet, ground, vehicle_at(vehicle, vehicle.samples.front().time_s));
  role.mounted.push_back(end);
  role.ends.push_back(radio_end(mount, vehicle, first, ground.origin_m));
}

void require_carriers(const std::vector<MountConfig>& mounts, const Trajectories& trajectories) {
  std::vector<std::string> names;
  for (const Track& track : trajectories.tracks) names.push_back(track.id);
  for (const VehicleType& type : trajectories.types) names.push_back(type.name);
  for (const MountConfig& mount : mounts)
    require_match(mount.on, names, "[[mount]] \"" + mount.name + "\", on", "vehicle and of no type");
}

}  // namespace

std::optional<double> GroundBelow::height_m(const glm::dvec3& place_m) const {
  const std::optional<double> z_m = ground->height_m(glm::dvec2(origin_m + place_m));
  return z_m ? std::optional(*z_m - origin_m.z) : std::nullopt;
}

GroundBelow ground_below(const std::vector<MountConfig>& mounts, PlaceFinder& places, const glm::dvec3& origin_m) {
  const bool asked = std::ranges::any_of(mounts, [](const MountConfig& m) { return from_ground(m.above); });
  return {asked ? places.ground() : nullptr, origin_m};
}

EndsOfRole standing_ends(SharedList<RadioEnd> ends, const glm::dvec3& origin_m) {
  EndsOfRole out{std::move(ends), {}, {}};
  const std::vector<RadioEnd>& from = out.ends;
  std::vector<EndState> standing(from.size());
  tbb::parallel_for(size_t{0}, from.size(), [&](size_t i) {
    standing[i] = {.position_m = vector_of(from[i].position_m) - origin_m,
                   .rotation = rotation_of(from[i].orientation_deg),
                   .velocity_m_s = vector_of(from[i].velocity_m_s)};
  });
  out.standing = std::move(standing);
  return out;
}

WorldEnds with_mounts(WorldEnds standing, const std::vector<MountConfig>& mounts, const Fleet& fleet,
                      const GroundBelow& ground, bool by_id) {
  const Trajectories& trajectories = fleet.trajectories;
  require_carriers(mounts, trajectories);
  WorldEnds out = std::move(standing);
  if (mounts.empty() || trajectories.tracks.empty()) return out;
  std::set<std::string> taken;
  for (const auto* role : {&out.transmitters, &out.receivers})
    for (const RadioEnd& end : role->ends.values()) taken.insert(end.name);
  for (uint32_t k = 0; k < trajectories.tracks.size(); ++k) {
    const Track& track = trajectories.tracks[k];
    if (!track.mounts) continue;
    for (const MountConfig& mount : mounts) {
      const bool named = by_id && matches(mount.on, track.id);
      if (!named && !matches(mount.on, trajectories.types[track.type].name)) continue;
      if (const std::string name = track.id + "/" + mount.name; !taken.insert(name).second)
        throw ConfigError(fmt::format(
            "[[mount]] \"{}\": a radio end of the name \"{}\" exists already: rename one of them", mount.name, name));
      if (sends(mount.role)) add_mounted(out.transmitters, mount, fleet, ground, k);
      if (receives(mount.role)) add_mounted(out.receivers, mount, fleet, ground, k);
    }
  }
  return out;
}

SharedList<EndState> ends_at(const EndsOfRole& role, const Fleet& fleet, const GroundBelow& ground,
                             const std::vector<VehicleState>& vehicles) {
  SharedList<EndState> out = role.standing;
  for (const MountedEnd& end : role.mounted) out.push_back(mounted_at(end, fleet, ground, vehicles[end.track]));
  return out;
}

TwinEnds find_twins(const WorldEnds& ends) {
  const auto& [transmitters, receivers] = ends;
  using PlaceKey = std::tuple<uint32_t, bool, double, double, double>;
  const auto place = [](const EndsOfRole& role, size_t i) {
    const bool stands = i < role.standing.size();
    if (stands) {
      const glm::dvec3& p = role.standing[i].position_m;
      return PlaceKey{no_vehicle, false, p.x, p.y, p.z};
    }
    const MountedEnd& end = role.mounted[i - role.standing.size()];
    return PlaceKey{end.track, end.above_ground, end.offset_m.x, end.offset_m.y, end.offset_m.z};
  };
  TwinEnds out{std::vector<uint32_t>(transmitters.ends.size(), no_end),
               std::vector<uint32_t>(receivers.ends.size(), no_end)};
  std::set<PlaceKey> sending;  // receivers may be millions, and few of them send
  for (uint32_t tx = 0; tx < transmitters.ends.size(); ++tx) sending.insert(place(transmitters, tx));
  std::map<PlaceKey, uint32_t> at;
  for (uint32_t rx = 0; rx < receivers.ends.size(); ++rx)
    if (const PlaceKey key = place(receivers, rx); sending.contains(key)) at.emplace(key, rx);
  for (uint32_t tx = 0; tx < transmitters.ends.size(); ++tx) {
    const auto found = at.find(place(transmitters, tx));
    if (found == at.end() || out.transmitter_of_receiver[found->second] != no_end) continue;
    out.receiver_of_transmitter[tx] = found->second;
    out.transmitter_of_receiver[found->second] = tx;
  }
  return out;
}

}  // namespace wavetracer
