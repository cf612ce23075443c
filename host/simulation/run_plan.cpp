// SPDX-License-Identifier: Apache-2.0
// Each value follows from those before it.
#include "simulation/run_plan.hpp"

#include "config/diffraction_range.hpp"
#include "config/edge_rays.hpp"
#include "radio/carriers.hpp"
#include "radio/opacity.hpp"
#include "scene/materials.hpp"
#include "simulation/feature_choice.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

Config with_all_ends(Config config, const World& world) {
  config.transmitters = world.transmitters.ends;
  config.receivers = world.receivers.ends;
  return config;
}

void check_at_rest(const World& world) {
  if (!world.resting)
    throw ConfigError(
        "trace.edge_rays needs a world in which nothing moves, and this one has vehicles: give 0, so that receivers "
        "launch rays, or remove the vehicles");
}

bool reuses(const TraceConfig& trace, const World& world, bool frames_follow) {
  return trace.reuse && (world.clock.frame_count() > 1 || world.live || frames_follow);
}

}  // namespace

Config RunPlan::computed() const {
  Config out = asked;
  out.trace = trace;
  return out;
}

RunPlan plan_run(const Config& asked, Scene scene, bool frames_follow) {
  World world = make_world(asked, scene);
  Config config = with_all_ends(asked, world);
  Features features = choose_features(config, scene, world, frames_follow);
  TraceConfig trace = with_features(config.trace, features);
  const bool alone = world.resting && world.fleet.instances.empty() && !reuses(trace, world, frames_follow);
  if (!trace.edge_rays) trace.edge_rays = alone ? config::edge_rays_of(config, trace) : 0;
  trace.diffraction_range_db = config::diffraction_range_of(config, trace);
  Origins origins =
      make_origins(world.twins.receiver_of_transmitter, world.twins.transmitter_of_receiver, trace.from_both_ends());
  if (trace.from_edges()) {
    check_at_rest(world);
    origins = hearing_origins(world.receivers.standing, origins.transmitter_count(), listener_size_m);
  }
  const bool reuse = reuses(trace, world, frames_follow);
  // A sphere receives what this frame's rays meet.
  const bool by_rays = !origins.squares && !trace.by_spheres() && !trace.by_beams();
  std::vector<WorldRadar> radars = world_radars(config, world, world.warnings);
  drop_used(scene.report.warnings, world.fleet.models);
  return {.scene = std::move(scene),
          .world = std::move(world),
          .asked = std::move(config),
          .features = std::move(features),
          .trace = trace,
          .origins = std::move(origins),
          .radars = std::move(radars),
          .reuse = reuse && by_rays,
          .keep_beams = reuse && trace.by_beams()};
}

std::vector<bool> opaque_surfaces(const RunPlan& plan) {
  std::vector<bool> out;
  if (!plan.trace.transmission) return out;
  const Fleet& fleet = plan.world.fleet;
  for (const double carrier_hz : carriers_hz(plan.asked.radio)) {
    const std::vector<bool> opaque = opaque_surfaces(plan.scene, fleet.models, fleet.instances, carrier_hz);
    if (out.empty()) out.assign(opaque.size(), true);
    for (size_t i = 0; i < out.size(); ++i) out[i] = out[i] && opaque[i];
  }
  return out;
}

std::vector<glm::dvec3> first_transmitters(const World& world) {
  std::vector<glm::dvec3> out;
  for (const EndState& end : world.state(0).transmitters) out.push_back(end.position_m);
  return out;
}

}  // namespace wavetracer
