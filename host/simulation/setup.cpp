// SPDX-License-Identifier: Apache-2.0
// The parts of a setup, each made of the plan and of parts before it.
#include "simulation/setup.hpp"

#include <functional>

#include "radio/carriers.hpp"
#include "radio/constants.hpp"
#include "scene/ground_sheets.hpp"
#include "scene/load.hpp"
#include "simulation/device_proof.hpp"
#include "simulation/place_warnings.hpp"
#include "simulation/scene_on_device.hpp"
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

double longest_wavelength_m(const RadioConfig& radio) {
  return speed_of_light_m_s / std::ranges::min(carriers_hz(radio));
}

// The scene with its instances where they are in the first frame.
SceneOnDevice upload(gpu::Context& context, const RunPlan& plan) {
  const World& world = plan.world;
  const std::vector<bool> opaque = opaque_surfaces(plan);
  DeviceScene still = choose_tree(context, plan.scene, plan.trace, first_transmitters(world), world.reach_m, opaque);
  return place_instances(context, std::move(still), plan.scene, world, opaque);
}

OrderChoice make_order(gpu::Context& context, const RunPlan& plan, const DeviceScene& scene) {
  const Config& asked = plan.asked;
  if (!asked.order.by_trial()) return {plan_order(asked.order, asked.launch), ""};
  return choose_order(context, plan.scene, scene, asked.order, asked.launch, plan.trace,
                      first_transmitters(plan.world));
}

std::unique_ptr<RayTrails> make_trails(gpu::Context& context, const RunPlan& plan) {
  const uint64_t waypoints = plan.asked.output.waypoints;
  if (!plan.trace.by_spheres() && waypoints == 0) return nullptr;
  const Fleet& fleet = plan.world.fleet;
  return std::make_unique<RayTrails>(context, plan.trace, waypoints, tracing_depth(plan.trace).reflections,
                                     SurfaceTable(plan.scene, fleet.models, fleet.instances));
}

std::optional<LaunchWindows> make_windows(const RunPlan& plan, bool followed) {
  std::optional<LaunchWindows> out;
  const Fleet& fleet = plan.world.fleet;
  if (!plan.trace.by_spheres())
    out.emplace(plan.scene, fleet.models, fleet.instances, followed || plan.asked.cache.on());
  return out;
}

std::unique_ptr<RayCache> make_cache(gpu::Context& context, const RunPlan& plan, const DeviceScene& scene,
                                     const OrderPlan& order, RayTrails* trails) {
  if (!plan.asked.cache.on()) return nullptr;
  CachedReception reception;
  if (plan.trace.by_spheres()) reception = {trails, plan.trace.sphere_radius_m};
  return std::make_unique<RayCache>(context, scene, plan.asked.cache,
                                    cache_world(plan.scene, plan.world, plan.origins.count()),
                                    choose_shape(context.info(), plan.trace, order), order.launch, reception);
}

// Paths over more edges than these are found by strings between their ends, not by what each end sees (wedge_chains).
constexpr uint32_t most_joined_edges = 2;

// The triangles of the first frame are those of all frames where nothing moves.
std::unique_ptr<BeamTracing> make_beams(gpu::Context& context, const RunPlan& plan, const FrameWatch& watch) {
  if (!plan.trace.by_beams()) return nullptr;
  const Fleet& fleet = plan.world.fleet;
  const BeamOptions options{
      .max_transmissions = plan.trace.transmission ? plan.trace.max_transmissions : 0,
      .max_diffractions = plan.trace.diffraction ? std::min(plan.trace.max_diffractions, most_joined_edges) : 0,
      .mirrors = make_reflectance_bounds(plan.scene, fleet.models, fleet.instances, carriers_hz(plan.asked.radio)),
      .floor_db = plan.trace.floor_db,
      .wavelength_m = longest_wavelength_m(plan.asked.radio)};
  auto out = std::make_unique<BeamTracing>(context, plan.scene, fleet.models, options, &watch);
  out->set_world(fleet.instances, plan.world.state(0).instances);
  return out;
}

std::unique_ptr<const PathLifetimes> make_lifetimes(const RunPlan& plan) {
  if (!plan.asked.output.lifetimes) return nullptr;
  return std::make_unique<const PathLifetimes>(plan.scene, plan.world.fleet.models, plan.world.fleet.instances);
}

// Is the ground many surfaces? A street of a few patches is not, the coarsest of terrains is.
bool is_hilly(const Scene& scene) { return ground_surfaces(scene) > 100; }

// Adds a warning of too many ways over edges to tiles, which the frame counts and may refuse.
std::vector<std::string> with_pairs(std::vector<std::string> warnings, const Origins& origins, const TraceConfig& trace,
                                    const ExactPaths& exact) {
  if (!exact.scattered_edges) return warnings;
  std::string told = warning_of_pairs(origins.count(), exact.diffraction->wedges.diffracting(),
                                      exact.scatter->tiles().count, trace.scattering_floor_db.has_value());
  if (!told.empty()) warnings.push_back(std::move(told));
  return warnings;
}

// own: null where the caller lends the context.
Setup set_up(std::unique_ptr<gpu::Context> own, gpu::Context& context, const Config& asked,
             const std::function<Scene()>& load, bool frames_follow, const PlanCheck& check) {
  StageClock stages;
  stages.end("device");
  Scene loaded = load();
  stages.end("load");
  auto plan = std::make_unique<const RunPlan>(plan_run(asked, std::move(loaded), frames_follow));
  if (check) check(*plan);
  const auto& [scene, world, config, features, trace, origins, radars, reuse, keep_beams] = *plan;
  auto around = std::make_unique<const Surroundings>(scene);
  std::vector<std::string> warnings = place_warnings(asked, *around, world);
  auto [device_scene, placement] = upload(context, *plan);
  LaunchSides launch_sides(scene, world.fleet.models, world.fleet.instances);
  stages.end("build");
  const OrderChoice order = make_order(context, *plan, device_scene);
  if (config.order.by_trial()) stages.end("order");
  std::optional<LaunchSlopes> slopes;
  if (by_slopes(trace.directions)) slopes.emplace(*around, world.reach_m);
  auto trails = make_trails(context, *plan);
  auto windows = make_windows(*plan, trails != nullptr);
  auto cache = make_cache(context, *plan, device_scene, order.plan, trails.get());
  auto watch = std::make_unique<FrameWatch>();
  auto discovery = std::make_unique<Discovery>(context, device_scene, trace,
                                               DiscoveryOptions{.order = order.plan,
                                                                .keep_ages = reuse,
                                                                .finder = cache.get(),
                                                                .follower = trails.get(),
                                                                .watch = watch.get(),
                                                                .hilly = !trace.rays && is_hilly(scene)});
  auto beams = make_beams(context, *plan, *watch);
  ExactPaths exact(context, device_scene, scene, world, trace, longest_wavelength_m(config.radio), reuse);
  if (origins.squares)
    exact.from_edges = std::make_unique<EdgeDiscovery>(context, device_scene, trace, origins, *watch);
  FinishedPaths finish(context, scene, plan->computed(), world);
  ElementOutputs elements(config, scene, world, radars);
  auto lifetimes = make_lifetimes(*plan);
  return {.stages = stages,
          .own_context = std::move(own),
          .context = context,
          .device = summary_of(context.info()),
          .plan = std::move(plan),
          .around = std::move(around),
          .place_warnings = with_pairs(std::move(warnings), origins, trace, exact),
          .device_scene = std::move(device_scene),
          .placement = std::move(placement),
          .launch_sides = std::move(launch_sides),
          .order = order,
          .order_summary = summary_of(order),
          .slopes = std::move(slopes),
          .trails = std::move(trails),
          .windows = std::move(windows),
          .cache = std::move(cache),
          .frame_watch = std::move(watch),
          .discovery = std::move(discovery),
          .beams = std::move(beams),
          .exact_paths = std::move(exact),
          .finish = std::move(finish),
          .elements = std::move(elements),
          .lifetimes = std::move(lifetimes)};
}

}  // namespace

Setup make_setup(const Config& asked, const std::string& device_text, bool frames_follow, const PlanCheck& check) {
  auto context = std::make_unique<gpu::Context>(device_text);
  gpu::Context& device = *context;
  Setup out = set_up(
      std::move(context), device, asked, [&] { return load_scene(asked); }, frames_follow, check);
  out.stages.end("compile");
  for (const CheckedFeatures& features : features_to_check(out)) prove_device(device, features);
  out.stages.end("device check");
  return out;
}

Setup make_setup(gpu::Context& context, const Config& asked, const Scene& scene, bool frames_follow) {
  return set_up(nullptr, context, asked, [&] { return scene; }, frames_follow, {});
}

}  // namespace wavetracer
