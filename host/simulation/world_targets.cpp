// SPDX-License-Identifier: Apache-2.0
// Points are numbered in the order of their targets, so that a number means the same point in all frames.
#include "simulation/world_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <map>
#include <numbers>

#include "radio/antenna.hpp"
#include "radio/body_bounces.hpp"
#include "radio/target_laws.hpp"
#include "simulation/name_pattern.hpp"
#include "wavetracer/device/vector.h"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

// pieces: those of its body, whose surfaces begin at first_surface; null where it has none.
void add_target(Targets& to, Target target, const TargetModelConfig& model, const std::vector<TargetPartConfig>& parts,
                const std::optional<glm::dvec3>& size_m, uint32_t law, const TargetLaws::BodyLaws* body = nullptr,
                uint32_t first_surface = 0) {
  target.model = model.name;
  target.first_point = static_cast<uint32_t>(to.points.size());
  const auto number = static_cast<uint32_t>(to.all.size());
  for (const glm::dvec3& arm_m : points_of(model, size_m)) to.points.push_back({number, law++, arm_m});
  for (size_t i = 0; body && i < body->pieces.size(); ++i) {
    const TargetPiece& piece = body->pieces[i];
    to.points.push_back({.target = number,
                         .law = body->first_law + static_cast<uint32_t>(i),
                         .arm_m = piece.centre_m,
                         .surface = first_surface + piece.surface,
                         .lit_above = piece.lit_above,
                         .lit_below = piece.lit_below});
  }
  for (const TargetPartConfig& part : parts) {
    if (part.model != model.name) continue;
    for (uint32_t point = 0; point < part.points; ++point)
      to.points.push_back({number, law, glm::dvec3(0), point_of_part(part, point)});
    ++law;
  }
  target.point_count = static_cast<uint32_t>(to.points.size()) - target.first_point;
  to.all.push_back(std::move(target));
}

// The chains of bounces within bodies, which are made once for each target model and model of a vehicle.
class BodyChains {
 public:
  BodyChains(const Config& config, const Fleet& fleet, const TargetLaws& laws)
      : config_(config), fleet_(fleet), laws_(laws) {}

  // Adds those of the target that was added last; model: its number.
  void add(Targets& to, size_t model, const Instance& body) {
    const TargetModelConfig& of = config_.target_models[model];
    const auto [chains, is_new] = made_.try_emplace({model, body.model});
    if (is_new)
      chains->second = bounces_of_body(fleet_.models[body.model], laws_.bodies[model][body.model].pieces,
                                       of.bounces.value_or(1), of.name);
    if (constexpr size_t most = size_t{1} << 26; to.bounces.size() + chains->second.size() > most)
      throw ConfigError(fmt::format(
          "[[target_model]] \"{}\" with bounces = {}: the bodies of all targets have more than {} chains of "
          "facets together: lower bounces, raise piece_m, or let fewer vehicles be such targets",
          of.name, of.bounces.value_or(1), most));
    for (const BodyBounce& chain : chains->second)
      to.bounces.push_back({.point = to.all.back().first_point + chain.piece,
                            .count = chain.count,
                            .mirrors = {body.first_surface + chain.mirrors[0], body.first_surface + chain.mirrors[1]}});
  }

 private:
  const Config& config_;
  const Fleet& fleet_;
  const TargetLaws& laws_;
  std::map<std::pair<size_t, uint32_t>, std::vector<BodyBounce>> made_;
};

// Sets the bounds of what the point sends.
void bound(TargetPoint& point, const TargetLaws& laws) {
  const device::wt_target_law& law = laws.laws[point.law];
  if (law.lobe_count == WT_FACET_LAW) {
    const auto corner = [&](int k) { return device::wt_vector(laws.facets[law.first_lobe].corners + 3 * k); };
    point.area_m2 = 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
    return;
  }
  double most_db = -std::numeric_limits<double>::infinity();
  for (uint32_t lobe = law.first_lobe; lobe < law.first_lobe + law.lobe_count; ++lobe)
    most_db = std::max(most_db, laws.lobes[lobe].peak_db);
  point.section_m2 = std::pow(10.0, most_db / 10) * (1 + law.cross) * (1 + law.cross);
}

// The ways of the vehicles with parts.
std::vector<std::optional<Travel>> travels_of(const Targets& targets, const Trajectories& trajectories) {
  std::vector<std::optional<Travel>> out;
  for (const TargetPoint& point : targets.points) {
    const auto& track = targets.all[point.target].track;
    if (!point.part || !track) continue;
    out.resize(trajectories.tracks.size());
    if (!out[*track]) out[*track].emplace(trajectories.tracks[*track]);
  }
  return out;
}

// The way of a target at a time. One that stands is on a treadmill: parts turn with its velocity.
Travelled travelled_by(const Targets& targets, const Target& target, const Fleet& fleet,
                       const std::vector<VehicleState>& vehicles, double time_s) {
  if (target.track && vehicles[*target.track].travelled) return *vehicles[*target.track].travelled;
  if (target.track) return targets.travels[*target.track]->at(fleet.trajectories.tracks[*target.track], time_s);
  const glm::dvec3 velocity_m_s = glm::conjugate(target.pose.orientation) * target.pose.velocity_m_s;
  return {.way_m = velocity_m_s * time_s, .velocity_m_s = velocity_m_s};
}

void check_body(const Fleet& fleet, const WorldEnds& ends, uint32_t track, const TargetModelConfig& model) {
  if (fleet.instance_of_track[track] != no_instance) return;
  for (const EndsOfRole* role : {&ends.transmitters, &ends.receivers})
    for (const MountedEnd& end : role->mounted)
      if (end.track == track)
        throw ConfigError(fmt::format(
            "[[target_model]] \"{}\": the vehicle \"{}\" is a target, carries an antenna and has no body, so "
            "that its antenna would see its own points: give its [[vehicle_type]] a body, or choose other "
            "vehicles by on",
            model.name, fleet.trajectories.tracks[track].id));
}

// A vehicle has one body, whose facets must not count twice.
void check_one_body(const Config& config, const Track& track, const VehicleType& type, bool by_id) {
  const TargetModelConfig* first = nullptr;
  for (const TargetModelConfig& model : config.target_models) {
    if (!model.body() || !(matches(model.on, type.name) || (by_id && matches(model.on, track.id)))) continue;
    if (first)
      throw ConfigError(fmt::format(
          "[[target_model]] \"{}\" and \"{}\" have kind = \"body\" and both select the vehicle \"{}\", whose facets "
          "would count twice: change on of one of them",
          first->name, model.name, track.id));
    first = &model;
  }
}

// Points are numbered with the bits that a step has beside its kind.
void check_points(const Targets& targets) {
  if (targets.points.size() <= static_cast<size_t>(~WT_STEP_KIND)) return;
  throw ConfigError(fmt::format(
      "the targets have {} points, more than the {} that paths can tell apart: give bodies a larger piece_m, "
      "or make fewer vehicles targets (target_model.on)",
      targets.points.size(), ~WT_STEP_KIND));
}

const Instance& body_of_vehicle(const Fleet& fleet, uint32_t track, const TargetModelConfig& model) {
  const uint32_t instance = fleet.instance_of_track[track];
  if (instance == no_instance)
    throw ConfigError(
        fmt::format("[[target_model]] \"{}\" has kind = \"body\", but the vehicle \"{}\" has no body: give its "
                    "[[vehicle_type]] a model, or choose other vehicles by on",
                    model.name, fleet.trajectories.tracks[track].id));
  return fleet.instances[instance];
}

// The body of a target that stands, or null.
const Instance* standing_instance(const Fleet& fleet, uint32_t target) {
  for (size_t i = 0; i < fleet.standing.size(); ++i)
    if (fleet.standing[i].target == target) return &fleet.instances[fleet.instance_of_standing(i)];
  return nullptr;
}

// Length, width and height of a body.
std::optional<glm::dvec3> body_size(const Scene& model) { return model.upper - model.lower; }

// by_id: the vehicles of the world are tracks, which on may name.
void require_vehicles(const Config& config, const Trajectories& trajectories, bool by_id) {
  std::vector<std::string> names;
  for (size_t i = 0; by_id && i < trajectories.tracks.size(); ++i) names.push_back(trajectories.tracks[i].id);
  for (const VehicleType& type : trajectories.types) names.push_back(type.name);
  for (const TargetModelConfig& model : config.target_models)
    if (!model.on.empty())
      require_match(model.on, names, "[[target_model]] \"" + model.name + "\", on", "vehicle and of no type");
}

const TargetModelConfig& model_of(const Config& config, const std::string& name) {
  return *std::ranges::find(config.target_models, name, &TargetModelConfig::name);
}

}  // namespace

Targets make_targets(const Config& config, const Fleet& fleet, const WorldEnds& ends, const glm::dvec3& origin_m,
                     bool by_id) {
  Targets out;
  if (!config.trace.target) return out;
  const TargetLaws laws = target_laws(config.target_models, config.target_parts, fleet.models);
  const Trajectories& trajectories = fleet.trajectories;
  BodyChains bounces(config, fleet, laws);
  require_vehicles(config, trajectories, by_id);
  for (uint32_t k = 0; k < trajectories.tracks.size(); ++k) {
    const Track& track = trajectories.tracks[k];
    const VehicleType& type = trajectories.types[track.type];
    check_one_body(config, track, type, by_id);
    for (size_t m = 0; m < config.target_models.size(); ++m) {
      const TargetModelConfig& model = config.target_models[m];
      if (!matches(model.on, type.name) && !(by_id && matches(model.on, track.id))) continue;
      check_body(fleet, ends, k, model);
      const glm::dvec3 size_m{type.length_m, type.width_m, type.height_m};
      const Instance* body = model.body() ? &body_of_vehicle(fleet, k, model) : nullptr;
      const uint32_t instance = fleet.instance_of_track[k];
      add_target(out, {.name = track.id + "/" + model.name, .model = {}, .track = k, .instance = instance}, model,
                 config.target_parts, size_m.z > 0 ? std::optional(size_m) : std::nullopt, laws.first[m],
                 body ? &laws.bodies[m][body->model] : nullptr, body ? body->first_surface : 0);
      if (body) bounces.add(out, m, *body);
    }
  }
  for (const TargetConfig& standing : config.targets) {
    const TargetModelConfig& model = model_of(config, standing.model);
    const auto m = static_cast<size_t>(&model - config.target_models.data());
    const Instance* stands = standing_instance(fleet, static_cast<uint32_t>(&standing - config.targets.data()));
    const Instance* body = model.body() ? stands : nullptr;
    Target target{.name = standing.name, .model = {}, .track = {}, .pose = standing_pose(standing, origin_m)};
    if (stands) target.instance = static_cast<uint32_t>(stands - fleet.instances.data());
    add_target(out, std::move(target), model, config.target_parts,
               stands ? body_size(fleet.models[stands->model]) : std::nullopt, laws.first[m],
               body ? &laws.bodies[m][body->model] : nullptr, body ? body->first_surface : 0);
    if (body) bounces.add(out, m, *body);
  }
  check_points(out);
  for (TargetPoint& point : out.points) bound(point, laws);
  out.travels = travels_of(out, trajectories);
  return out;
}

std::vector<uint32_t> body_instances(const Targets& targets, const Fleet& fleet) {
  std::vector<uint32_t> out;
  for (const TargetPoint& point : targets.points) {
    if (point.surface == no_target_surface) continue;
    out.resize(fleet.instances.size(), 0);
    out[targets.all[point.target].instance] = 1;
  }
  return out;
}

// The matrix of a facet (facet.h) has entries of 4 at most, so a piece of area A sends a wave of at most
// 4 sqrt(2) A / (2 wavelength) on, whatever the polarization; its gain does not depend on the wavelength.
double TargetPoint::power(double wavelength_m) const {
  const double at_1_m = 1 / std::pow(4 * std::numbers::pi, 3);
  return at_1_m * (wavelength_m * wavelength_m * section_m2 + 32 * std::numbers::pi * area_m2 * area_m2);
}

double TargetPoint::reach_m() const { return part ? glm::length(part->pivot_m) + part->arm_m : glm::length(arm_m); }

std::vector<TargetState> targets_at(const Targets& targets, const Fleet& fleet,
                                    const std::vector<VehicleState>& vehicles, double time_s) {
  std::vector<TargetState> out;
  out.reserve(targets.points.size());
  std::optional<uint32_t> rolling;  // the target that `travelled` belongs to
  Travelled travelled;
  for (const TargetPoint& point : targets.points) {
    const Target& target = targets.all[point.target];
    const bool rides = target.track.has_value();
    const Pose& pose = rides ? vehicles[*target.track].pose : target.pose;
    PartPlace place{point.arm_m, glm::dvec3(0)};
    if (point.part) {
      if (rolling != point.target) travelled = travelled_by(targets, target, fleet, vehicles, time_s);
      rolling = point.target;
      place = place_of(*point.part, travelled);
    }
    out.push_back({.position_m = position_at(pose, place.arm_m),
                   .rotation = glm::mat3_cast(pose.orientation),
                   .velocity_m_s = velocity_at(pose, place.arm_m) + pose.orientation * place.velocity_m_s,
                   .instance = target.instance,
                   .law = point.law,
                   .present = !rides || vehicles[*target.track].present,
                   .surface = point.surface,
                   .lit_above = point.lit_above,
                   .lit_below = point.lit_below});
  }
  return out;
}

void name_targets(Paths& paths, const Targets& targets) {
  if (targets.empty()) return;
  paths.target.assign(paths.size(), no_target);
  for (size_t row = 0; row < paths.size(); ++row)
    for (uint64_t k = paths.vertex_offset[row]; k < paths.vertex_offset[row + 1]; ++k) {
      if (paths.vertex_interaction[k] != target_point) continue;
      const uint32_t target = targets.points[paths.vertex_surface[k]].target;
      paths.target[row] = target;
      paths.vertex_surface[k] -= targets.all[target].first_point;
    }
}

}  // namespace wavetracer
