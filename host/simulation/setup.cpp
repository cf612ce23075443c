// Members that need more than a constructor are made by functions, in the order of setup.hpp.
#include "simulation/setup.hpp"

#include "radio/carriers.hpp"
#include "radio/constants.hpp"
#include "radio/opacity.hpp"
#include "scene/load.hpp"
#include "scene/materials.hpp"
#include "scene/surface_sheets.hpp"
#include "simulation/device_proof.hpp"
#include "simulation/feature_choice.hpp"
#include "simulation/place_warnings.hpp"
#include "simulation/tracing_depth.hpp"
#include "simulation/tree_choice.hpp"

namespace wavetracer {

namespace {

DeviceSummary summary_of(const gpu::DeviceInfo& info) {
  return {info.platform, info.name, info.driver, info.opencl_c, info.gpu};
}

OrderSummary summary_of(const OrderChoice& choice) {
  const OrderPlan& plan = choice.plan;
  return {plan.method, plan.each_depth, std::to_string(plan.launch.dimensions) + "d", plan.launch.local_size,
          choice.reason};
}

Scene make_scene(Setup& s, const std::function<Scene()>& load) {
  s.end_stage("device");
  Scene out = load();
  s.end_stage("load");
  return out;
}

Config with_all_ends(Config config, const World& world) {
  config.transmitters = world.transmitters.ends;
  config.receivers = world.receivers.ends;
  return config;
}

std::vector<glm::dvec3> positions(const std::vector<EndState>& ends) {
  std::vector<glm::dvec3> out;
  for (const EndState& end : ends) out.push_back(end.position_m);
  return out;
}

double longest_wavelength_m(const RadioConfig& radio) {
  return speed_of_light_m_s / std::ranges::min(carriers_hz(radio));
}

std::vector<bool> opaque_at_all_carriers(const Setup& s) {
  std::vector<bool> out;
  for (const double carrier_hz : carriers_hz(s.config.radio)) {
    const auto opaque = opaque_surfaces(s.scene, s.world.fleet.models, s.world.fleet.instances, carrier_hz);
    if (out.empty()) out.assign(opaque.size(), true);
    for (size_t i = 0; i < out.size(); ++i) out[i] = out[i] && opaque[i];
  }
  return out;
}

std::optional<InstancePlacement> make_placement(Setup& s) {
  std::optional<InstancePlacement> out;
  if (!s.world.fleet.instances.empty()) {
    out.emplace(s.context, s.world.fleet.models, s.world.fleet.instances, s.device_scene);
    out->place(s.device_scene, s.world.state(0).instances);
  }
  if (s.trace.transmission) mark_opaque(s.device_scene, opaque_at_all_carriers(s));
  return out;
}

OrderChoice make_order(Setup& s) {
  s.end_stage("build");
  if (s.config.order.method != "auto") return {plan_order(s.config.order, s.config.launch), ""};
  OrderChoice out =
      choose_order(s.context, s.scene, s.device_scene, s.config, positions(s.world.state(0).transmitters));
  s.end_stage("order");
  return out;
}

bool receives_by_spheres(const Config& config) { return config.trace.reception == "sphere"; }

// A sphere receives what this frame's rays meet.
bool reuses(const Config& config, const World& world, bool frames_follow) {
  return config.trace.reuse && !receives_by_spheres(config) &&
         (world.clock.frame_count() > 1 || world.live || frames_follow);
}

std::optional<LaunchSlopes> make_slopes(const Setup& s) {
  std::optional<LaunchSlopes> out;
  if (s.trace.directions == "horizon") out.emplace(s.around, s.world.reach_m);
  return out;
}

std::optional<RayTrails> make_trails(Setup& s) {
  std::optional<RayTrails> out;
  if (receives_by_spheres(s.config) || s.config.output.waypoints > 0)
    out.emplace(s.context, s.trace, s.config.output.waypoints, tracing_depth(s.trace).reflections,
                SurfaceTable(s.scene, s.world.fleet.models, s.world.fleet.instances));
  return out;
}

std::optional<LaunchWindows> make_windows(const Setup& s) {
  std::optional<LaunchWindows> out;
  if (receives_by_spheres(s.config)) return out;
  out.emplace(s.scene, s.world.fleet.models, s.world.fleet.instances, s.trails || s.config.cache.kind != "none");
  return out;
}

std::optional<RayCache> make_cache(Setup& s) {
  std::optional<RayCache> out;
  if (s.config.cache.kind == "none") return out;
  CachedReception reception;
  if (receives_by_spheres(s.config)) reception = {&*s.trails, s.config.trace.sphere_radius_m};
  out.emplace(s.context, s.device_scene, s.config.cache, cache_world(s.scene, s.world, s.origins.count()),
              choose_shape(s.context.info(), s.trace, s.order.plan), s.order.plan.launch, reception);
  return out;
}

// Is the ground many surfaces? A street of a few patches is not, the coarsest of terrains is.
bool is_hilly(const Scene& scene) { return ground_surfaces(scene) > 100; }

DiscoveryOptions discovery_options(Setup& s) {
  return {.order = s.order.plan,
          .keep_ages = s.reuse,
          .finder = s.cache ? &*s.cache : nullptr,
          .follower = s.trails ? &*s.trails : nullptr,
          .watch = &s.frame_watch,
          .hilly = !s.trace.rays && is_hilly(s.scene)};
}

Config with_trace(Config config, const TraceConfig& trace) {
  config.trace = trace;
  return config;
}

}  // namespace

Setup::Setup(const Config& asked, const std::string& device_text, bool frames_follow)
    : Setup(
          std::make_unique<gpu::Context>(device_text), nullptr, asked, [&] { return load_scene(asked); },
          frames_follow) {
  end_stage("compile");
  prove_device(context, features_to_check(*this));
  end_stage("device check");
}

Setup::Setup(gpu::Context& lent, const Config& asked, const Scene& given, bool frames_follow)
    : Setup(
          nullptr, &lent, asked, [&] { return given; }, frames_follow) {}

Setup::Setup(std::unique_ptr<gpu::Context> own, gpu::Context* lent, const Config& asked,
             const std::function<Scene()>& load, bool frames_follow)
    : own_context(std::move(own)),
      context(own_context ? *own_context : *lent),
      device(summary_of(context.info())),
      scene(make_scene(*this, load)),
      world(make_world(asked, scene)),
      around(scene),
      place_warnings(wavetracer::place_warnings(asked, around, world)),
      config(with_all_ends(asked, world)),
      features(choose_features(config, scene, world)),
      trace(with_features(config.trace, features)),
      origins(
          make_origins(world.twins.receiver_of_transmitter, world.twins.transmitter_of_receiver, trace.diffraction)),
      device_scene(choose_tree(context, scene, config.trace, positions(world.state(0).transmitters), world.reach_m)),
      placement(make_placement(*this)),
      launch_sides(scene, world.fleet.models, world.fleet.instances),
      order(make_order(*this)),
      order_summary(summary_of(order)),
      reuse(reuses(config, world, frames_follow)),
      slopes(make_slopes(*this)),
      trails(make_trails(*this)),
      windows(make_windows(*this)),
      cache(make_cache(*this)),
      discovery(context, device_scene, trace, discovery_options(*this)),
      exact_paths(context, device_scene, scene, world, trace, longest_wavelength_m(config.radio), origins, reuse),
      finish(context, scene, with_trace(config, trace), world),
      elements(config, scene, world) {
  drop_used(scene.report.warnings, world.fleet.models);
}

}  // namespace wavetracer
