// The world of a configuration, made once: tracks, bodies and antennas on them; then its state at any frame.
// Tracks are recentred as they are loaded, so that everything here is in coordinates of the recentred scene.
#include "simulation/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <set>

#include "base/spelling.hpp"
#include "motion/frame_clock.hpp"
#include "radio/antenna.hpp"
#include "simulation/live_places.hpp"
#include "simulation/name_pattern.hpp"
#include "simulation/place_finder.hpp"
#include "simulation/receiver_grid.hpp"
#include "simulation/world_clock.hpp"
#include "simulation/world_ends.hpp"
#include "simulation/world_links.hpp"
#include "simulation/world_models.hpp"
#include "simulation/world_reach.hpp"
#include "simulation/world_trajectories.hpp"
#include "wavetracer/device/records.h"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// A vehicle at one instant. Where it is absent, it is as it was last, or will be first.
struct VehicleState {
  Pose pose;
  bool present;
};

VehicleState vehicle_at(const Track& track, double time_s) {
  if (const auto pose = pose_at(track, time_s)) return {*pose, true};
  const auto later = std::upper_bound(track.samples.begin(), track.samples.end(), time_s,
                                      [](double time, const Sample& s) { return time < s.time_s; });
  const Sample& last = later == track.samples.begin() ? *later : *(later - 1);
  return {*pose_at(track, last.time_s), false};
}

// A place on a vehicle: an antenna, or the origin of its model. Axes as the vehicle's: ahead, left, up.
glm::dvec3 position_at(const Pose& pose, const glm::dvec3& arm_m) { return pose.position_m + pose.orientation * arm_m; }
glm::dvec3 velocity_at(const Pose& pose, const glm::dvec3& arm_m) {
  return pose.velocity_m_s + glm::cross(pose.angular_velocity_rad_s, pose.orientation * arm_m);
}

}  // namespace

struct World::State {
  std::optional<LivePlaces> live;
  Trajectories trajectories;  // recentred
  std::optional<FrameClock> clock;
  std::vector<Scene> models;
  std::vector<Instance> instances;
  std::vector<uint32_t> track_instance;  // of each track, no_instance where it has no body
  std::vector<uint32_t> instance_track;
  EndsOfRole transmitters, receivers;
  LinkRules links;
  TwinEnds twins;
  double reach_m = 0;
  std::vector<std::string> warnings;
  glm::dvec3 scene_origin_m{0};
  double lowest_m = 0, highest_m = 0;    // z of the scene
  std::shared_ptr<const Ground> ground;  // where an antenna of a vehicle stands above it

  void add_instances(VehicleModels& vehicles, const Scene& scene);
  void add_mounts(const std::vector<MountConfig>& mounts, const glm::dvec3& origin_m);
  glm::dvec3 offset_of(const MountConfig& mount, uint32_t track) const;
  void add_mounted(EndsOfRole& role, uint32_t track, const MountConfig& mount, const glm::dvec3& origin_m);
  glm::dvec3 mounted_position(const MountedEnd& end, const Pose& pose) const;
  EndState mounted_state(const MountedEnd& end, const VehicleState& vehicle) const;
  void set_links(const LinksConfig& config);
  double from_ground_m(const MountedEnd& end) const;
  void set_reach(const glm::dvec3& origin_m);
  void warn_outside(const Scene& scene);
  WorldState state(double time_s, const std::vector<VehicleState>& vehicles) const;
  WorldState live_state(double time_s, const std::vector<PlacedPose>& placed) const;
  void set_names(const std::vector<std::string>& ids, LiveFrame& frame) const;
};

void World::State::add_instances(VehicleModels& vehicles, const Scene& scene) {
  uint64_t next_surface = scene.surfaces.size(), next_wedge = scene.wedges.size();
  for (uint32_t k = 0; k < trajectories.tracks.size(); ++k) {
    const Track& track = trajectories.tracks[k];
    const VehicleType& type = trajectories.types[track.type];
    const std::optional<uint32_t> model = vehicles.model_of(type, track.id);
    track_instance.push_back(model ? static_cast<uint32_t>(instances.size()) : no_instance);
    if (!model) continue;
    instances.push_back(
        {track.id, type.name, *model, static_cast<uint32_t>(next_surface), static_cast<uint32_t>(next_wedge)});
    instance_track.push_back(k);
    next_surface += vehicles.models()[*model].surfaces.size();
    next_wedge += vehicles.models()[*model].wedges.size();
    if (next_surface > ~WT_STEP_KIND || next_wedge >= 1u << 27)
      throw RuntimeError(
          fmt::format("the scene and {} vehicles have more than 2^29 surfaces or 2^27 edges: use models "
                      "with fewer faces, or shorter trajectories",
                      instances.size()));
  }
  models = std::move(vehicles.models());
}

glm::dvec3 World::State::mounted_position(const MountedEnd& end, const Pose& pose) const {
  if (!end.above_ground) return position_at(pose, end.offset_m);
  glm::dvec3 out = position_at(pose, {end.offset_m.x, end.offset_m.y, 0});
  const std::optional<double> below_m = ground->height_m(glm::dvec2(scene_origin_m + out));
  out.z = (below_m ? *below_m - scene_origin_m.z : pose.position_m.z) + end.offset_m.z;
  return out;
}

EndState World::State::mounted_state(const MountedEnd& end, const VehicleState& vehicle) const {
  return {.position_m = mounted_position(end, vehicle.pose),
          .rotation = glm::mat3_cast(vehicle.pose.orientation) * end.rotation,
          .velocity_m_s = velocity_at(vehicle.pose, end.offset_m),
          .instance = track_instance[end.track],
          .present = vehicle.present};
}

// From the centre of the footprint.
glm::dvec3 World::State::offset_of(const MountConfig& mount, uint32_t track) const {
  if (mount.node.empty()) return vector_of(mount.offset_m);
  const Track& vehicle = trajectories.tracks[track];
  const std::string who = fmt::format("[[mount]] \"{}\": node = \"{}\": the vehicle \"{}\" of type \"{}\"", mount.name,
                                      mount.node, vehicle.id, trajectories.types[vehicle.type].name);
  if (track_instance[track] == no_instance)
    throw ConfigError(who + " has no body, and so no nodes: leave node out, or choose other vehicles by on");
  const Scene& model = models[instances[track_instance[track]].model];
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

// As it is where its vehicle first appears.
void World::State::add_mounted(EndsOfRole& role, uint32_t track, const MountConfig& mount, const glm::dvec3& origin_m) {
  const Track& vehicle = trajectories.tracks[track];
  role.mounted.push_back({track, offset_of(mount, track), rotation_of(mount.orientation_deg), mount.above == "ground"});
  const EndState first = mounted_state(role.mounted.back(), vehicle_at(vehicle, vehicle.samples.front().time_s));
  const glm::dvec3 position_m = origin_m + first.position_m, velocity_m_s = first.velocity_m_s;
  role.ends.push_back({.name = vehicle.id + "/" + mount.name,
                       .position_m = {position_m.x, position_m.y, position_m.z},
                       .antenna = mount.antenna,
                       .polarization = mount.polarization,
                       .orientation_deg = mount.orientation_deg,
                       .velocity_m_s = {velocity_m_s.x, velocity_m_s.y, velocity_m_s.z},
                       .array = mount.array});
}

void World::State::add_mounts(const std::vector<MountConfig>& mounts, const glm::dvec3& origin_m) {
  std::vector<std::string> names;
  for (const Track& track : trajectories.tracks) names.push_back(track.id);
  for (const VehicleType& type : trajectories.types) names.push_back(type.name);
  for (const MountConfig& mount : mounts)
    require_match(mount.on, names, "[[mount]] \"" + mount.name + "\", on", "vehicle and of no type");
  std::set<std::string> taken;
  for (const auto* role : {&transmitters, &receivers})
    for (const RadioEnd& end : role->ends) taken.insert(end.name);
  for (uint32_t k = 0; k < trajectories.tracks.size(); ++k) {
    const Track& track = trajectories.tracks[k];
    if (!track.mounts) continue;
    for (const MountConfig& mount : mounts) {
      const bool by_id = !live && matches(mount.on, track.id);  // places have no ids that a user would know
      if (!by_id && !matches(mount.on, trajectories.types[track.type].name)) continue;
      if (const std::string name = track.id + "/" + mount.name; !taken.insert(name).second)
        throw ConfigError(fmt::format(
            "[[mount]] \"{}\": a radio end of the name \"{}\" exists already: rename one of them", mount.name, name));
      if (mount.role != "receiver") add_mounted(transmitters, k, mount, origin_m);
      if (mount.role != "transmitter") add_mounted(receivers, k, mount, origin_m);
    }
  }
}

void World::State::set_links(const LinksConfig& config) {
  const auto side = [](const EndsOfRole& role) {
    LinkSide out;
    for (const RadioEnd& end : role.ends) out.names.push_back(end.name);
    out.vehicles.assign(role.standing.size(), no_vehicle);
    for (const MountedEnd& end : role.mounted) out.vehicles.push_back(end.track);
    return out;
  };
  links = LinkRules(config, side(transmitters), side(receivers));
}

// How far the ground below an antenna may be from its vehicle.
double World::State::from_ground_m(const MountedEnd& end) const {
  if (!end.above_ground) return 0;
  double out = 0;
  for (const Sample& sample : trajectories.tracks[end.track].samples)
    out = std::max({out, std::abs(sample.position_m.z - lowest_m), std::abs(sample.position_m.z - highest_m)});
  return out;
}

void World::State::set_reach(const glm::dvec3& origin_m) {
  Reach reach(origin_m);
  std::vector<double> radius_m(trajectories.tracks.size(), 0);
  for (const auto& [role, word] : {std::pair{&transmitters, "transmitter"}, {&receivers, "receiver"}}) {
    for (size_t i = 0; i < role->standing.size(); ++i)
      reach.add_end(fmt::format("{} \"{}\"", word, role->ends[i].name), role->standing[i].position_m);
    for (const MountedEnd& end : role->mounted)
      radius_m[end.track] = std::max(radius_m[end.track], glm::length(end.offset_m) + from_ground_m(end));
  }
  for (size_t i = 0; i < instances.size(); ++i) {
    const Scene& model = models[instances[i].model];
    const glm::dvec3 far_m = glm::max(glm::abs(model.origin_m + model.lower), glm::abs(model.origin_m + model.upper));
    radius_m[instance_track[i]] = std::max(radius_m[instance_track[i]], glm::length(far_m));
  }
  for (size_t k = 0; k < radius_m.size(); ++k) {
    if (live)
      reach.add_box(live->bounds().lower_m - origin_m, live->bounds().upper_m - origin_m, radius_m[k]);
    else
      reach.add_track(trajectories.tracks[k], radius_m[k]);
  }
  reach_m = reach.metres();
}

void World::State::warn_outside(const Scene& scene) {
  size_t outside = 0;
  for (const Track& track : trajectories.tracks) {
    const Bounds b = bounds_of(track);
    outside += b.lower.x > scene.upper.x || b.upper.x < scene.lower.x || b.lower.y > scene.upper.y ||
               b.upper.y < scene.lower.y;
  }
  if (outside > 0)
    warnings.push_back(
        fmt::format("{} of {} vehicles are never inside the scene: check trajectories.offset_m and trajectories.scale",
                    outside, trajectories.tracks.size()));
}

World::World(const Config& config, const Scene& scene) : state_(std::make_unique<State>()) {
  State& s = *state_;
  VehicleModels vehicles(config);
  if (!config.live_vehicles.empty()) s.live.emplace(config, vehicles, scene);
  PlaceFinder places(config, scene);
  s.scene_origin_m = scene.origin_m;
  s.lowest_m = scene.lower.z;
  s.highest_m = scene.upper.z;
  if (std::ranges::any_of(config.mounts, [](const MountConfig& m) { return m.above == "ground"; }))
    s.ground = places.ground();
  s.trajectories = s.live ? s.live->tracks() : load_trajectories(config, vehicles, places);
  for (Track& track : s.trajectories.tracks)
    for (Sample& sample : track.samples) sample.position_m -= scene.origin_m;
  s.warnings = s.trajectories.warnings;
  s.transmitters = standing_ends(standing_transmitters(config, places), scene.origin_m);
  s.receivers = standing_ends(standing_receivers(config, scene, places), scene.origin_m);
  s.add_instances(vehicles, scene);
  for (std::string& warning : model_warnings(s.models, scene)) s.warnings.push_back(std::move(warning));
  s.add_mounts(config.mounts, scene.origin_m);
  s.set_links(config.links);
  s.twins = find_twins(s.transmitters, s.receivers);
  if (s.live || s.trajectories.tracks.empty())
    s.clock.emplace(0, 0, 1);
  else
    s.clock.emplace(make_clock(config.time, s.trajectories, s.warnings));
  s.set_reach(scene.origin_m);
  if (!s.live) s.warn_outside(scene);
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const std::vector<Scene>& World::models() const { return state_->models; }
const std::vector<Instance>& World::instances() const { return state_->instances; }
const std::vector<RadioEnd>& World::transmitters() const { return state_->transmitters.ends; }
const std::vector<RadioEnd>& World::receivers() const { return state_->receivers.ends; }
const Trajectories& World::trajectories() const { return state_->trajectories; }
bool World::any_link_allowed() const { return state_->links.any_allowed(); }
uint64_t World::frame_count() const { return state_->clock->frame_count(); }
double World::time_s(uint64_t frame) const { return state_->clock->time_s(frame); }
double World::step_s() const { return state_->clock->step_s(); }
double World::reach_m() const { return state_->reach_m; }
const std::vector<uint32_t>& World::receiver_of_transmitter() const { return state_->twins.receiver_of_transmitter; }
const std::vector<uint32_t>& World::transmitter_of_receiver() const { return state_->twins.transmitter_of_receiver; }
const std::vector<std::string>& World::warnings() const { return state_->warnings; }

WorldState World::State::state(double time_s, const std::vector<VehicleState>& vehicles) const {
  WorldState out;
  out.time_s = time_s;
  for (size_t i = 0; i < instances.size(); ++i) {
    const auto& [pose, present] = vehicles[instance_track[i]];
    const glm::dvec3& origin_m = models[instances[i].model].origin_m;
    out.instances.push_back({position_at(pose, origin_m), glm::mat3_cast(pose.orientation), velocity_at(pose, origin_m),
                             pose.angular_velocity_rad_s, present});
  }
  const auto ends = [&](const EndsOfRole& role) {
    std::vector<EndState> states = role.standing;
    for (const MountedEnd& end : role.mounted) states.push_back(mounted_state(end, vehicles[end.track]));
    return states;
  };
  out.transmitters = ends(transmitters);
  out.receivers = ends(receivers);
  out.links = links(out.transmitters, out.receivers);
  return out;
}

WorldState World::state(uint64_t frame) const {
  const State& s = *state_;
  const double time = time_s(frame);
  std::vector<VehicleState> vehicles;
  vehicles.reserve(s.trajectories.tracks.size());
  for (const Track& track : s.trajectories.tracks) vehicles.push_back(vehicle_at(track, time));
  if (s.live)
    for (VehicleState& vehicle : vehicles) vehicle.present = false;
  return s.state(time, vehicles);
}

bool World::live() const { return state_->live.has_value(); }

const LivePlaces& World::places() const {
  if (!live())
    throw ConfigError(
        "there is no [[live_vehicle]] table: a live world says with it how many vehicles of each type there may be");
  return *state_->live;
}

const std::vector<LiveType>& World::live_types() const { return places().types(); }
const LiveBounds& World::live_bounds() const { return places().bounds(); }

WorldState World::State::live_state(double time_s, const std::vector<PlacedPose>& placed) const {
  std::vector<VehicleState> vehicles;
  vehicles.reserve(trajectories.tracks.size());
  for (const Track& track : trajectories.tracks) vehicles.push_back({*pose_at(track, 0), false});
  for (const PlacedPose& at : placed) vehicles[at.place] = {at.pose, true};
  WorldState out = state(time_s, vehicles);
  out.arrivals = std::ranges::any_of(placed, &PlacedPose::arrives);
  return out;
}

WorldState World::live_state(LiveTraffic& traffic, double time_s, std::span<const LivePose> poses) const {
  return state_->live_state(time_s, places().place(traffic, time_s, poses));
}

WorldState World::live_state_between(const LiveTraffic& traffic, double time_s, LiveFrame& names) const {
  const std::vector<PlacedPose> placed = places().between(traffic, time_s);
  std::vector<std::string> ids(state_->trajectories.tracks.size());
  for (const PlacedPose& at : placed) ids[at.place] = at.id;
  state_->set_names(ids, names);
  return state_->live_state(time_s, placed);
}

void World::set_names(const LiveTraffic& traffic, LiveFrame& frame) const {
  std::vector<std::string> ids(state_->trajectories.tracks.size());
  for (const auto& [id, vehicle] : traffic.vehicles) ids[vehicle.place] = id;
  state_->set_names(ids, frame);
}

// ids: of the vehicles in all places, empty where there is none.
void World::State::set_names(const std::vector<std::string>& ids, LiveFrame& frame) const {
  for (const uint32_t track : instance_track) frame.instances.push_back(ids[track]);
  const auto names = [&](const EndsOfRole& role) {
    std::vector<std::string> out;
    for (size_t i = 0; i < role.ends.size(); ++i) {
      const std::string& name = role.ends[i].name;
      if (i < role.standing.size()) {
        out.push_back(name);
        continue;
      }
      const uint32_t track = role.mounted[i - role.standing.size()].track;
      const std::string& place = trajectories.tracks[track].id;  // the name is PLACE/MOUNT
      out.push_back(ids[track].empty() ? "" : ids[track] + name.substr(place.size()));
    }
    return out;
  };
  frame.transmitters = names(transmitters);
  frame.receivers = names(receivers);
}

}  // namespace wavetracer
