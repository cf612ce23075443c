// Simulation: a scene on a device, solved frame by frame. run_frame is the main loop of the program.
// Rays discover, geometry decides: see docs/architecture.md.
#include "wavetracer/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "radio/fields.hpp"
#include "radio/opacity.hpp"
#include "scene/load.hpp"
#include "simulation/discovery.hpp"
#include "simulation/distinct_paths.hpp"
#include "simulation/exact_paths.hpp"
#include "simulation/feature_choice.hpp"
#include "simulation/frame_watch.hpp"
#include "simulation/launch_sides.hpp"
#include "simulation/launch_slopes.hpp"
#include "simulation/link_block.hpp"
#include "simulation/listeners.hpp"
#include "simulation/missing_paths.hpp"
#include "simulation/order_choice.hpp"
#include "simulation/place_warnings.hpp"
#include "simulation/placement.hpp"
#include "simulation/reciprocity.hpp"
#include "simulation/stopwatch.hpp"
#include "simulation/tree_choice.hpp"
#include "simulation/world.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/live.hpp"

namespace wavetracer {

namespace {

constexpr uint64_t compiling_rays = 4096;  // of the launches that are there to be compiled
constexpr uint64_t refreshed_share = 10;   // of the directions, the part that a frame launches anew where none is given

std::vector<glm::dvec3> positions(const std::vector<EndState>& ends) {
  std::vector<glm::dvec3> out;
  for (const EndState& end : ends) out.push_back(end.position_m);
  return out;
}

// All directions in a cold frame; after it every stride-th, another set each time: `stride` frames together launch all.
// Steps of the golden ratio, so that a few frames spread evenly.
DirectionShare share_of(uint64_t rays, std::optional<uint64_t> refresh_rays, uint64_t warm_frames) {
  if (warm_frames == 0) return {};
  const uint64_t wanted = std::max<uint64_t>(refresh_rays.value_or(rays / refreshed_share), 1);
  const uint64_t stride = std::max<uint64_t>(rays / wanted, 1);
  auto step = static_cast<uint64_t>(0.6180339887498949 * static_cast<double>(stride)) + 1;
  while (std::gcd(step, stride) != 1) ++step;
  return {warm_frames * step % stride, stride};
}

// Rays of a listener: edges are met by many rays.
uint64_t listener_rays(const TraceConfig& config) {
  const uint64_t unasked = std::max<uint64_t>(*config.rays / 10, 100000);
  return std::min(config.diffraction_rays.value_or(unasked), *config.rays);
}

void add(const DiscoveryCounts& more, DiscoveryCounts& sum) {
  sum.rays += more.rays;
  sum.hits += more.hits;
  sum.segments_per_depth.resize(std::max(sum.segments_per_depth.size(), more.segments_per_depth.size()));
  for (size_t k = 0; k < more.segments_per_depth.size(); ++k) sum.segments_per_depth[k] += more.segments_per_depth[k];
}

// What a frame found is the asked share of the paths, as far as its rays can tell: never that it is all of them.
bool reached(double recall, const MissedCounts& counts) {
  const auto found = static_cast<double>(std::accumulate(counts.paths.begin(), counts.paths.end(), uint64_t{0}));
  return recall < 1 && counts.frames > 0 && found >= recall * (found + estimate_missed(counts).paths.estimate);
}

// What to say of a refined launch that ended before trace.recall; nothing where that is no loss: most sequences that
// rays meet once lead to no receiver. cold: the frame knows nothing of earlier ones, so that its own rays tell what is
// missed.
std::vector<std::string> missed_recall(const DiscoveryCounts& found, const TraceConfig& config, bool cold,
                                       const MissedCounts& missed) {
  const bool capped = found.end == LaunchEnd::max_rays;
  if (found.end == LaunchEnd::recall || !(capped || cold)) return {};
  if (!capped && reached(config.recall, missed)) return {};
  const std::string once = found.share_once < 0.005 ? "less than 1" : fmt::format("{:.0f}", 100 * found.share_once);
  const std::string before = fmt::format(
      "before trace.recall = {}: {}% of the sequences found were met by one ray alone", config.recall, once);
  if (capped)
    return {fmt::format("trace.max_rays = {} ended the launch of rays = \"auto\" {}", config.max_rays, before)};
  const char* const why = found.end == LaunchEnd::finest ? "its rays are as close to each other as they get"
                                                         : "the rays beside those met nothing that is rare";
  return {fmt::format("the launch of rays = \"auto\" ended {}, and {}; give trace.rays a number to find more", before,
                      why)};
}

// What the cache must know of the world.
CacheWorld cache_world(const Scene& scene, const World& world, const Origins& origins) {
  CacheWorld out{.transmitters = origins.count(),
                 .surfaces = static_cast<uint32_t>(scene.surfaces.size()),
                 .primitives = static_cast<uint32_t>(scene.triangles.size()),
                 .static_surfaces = static_cast<uint32_t>(scene.surfaces.size()),
                 .instances = static_cast<uint32_t>(world.instances().size())};
  for (const Instance& instance : world.instances()) {
    const Scene& model = world.models()[instance.model];
    out.surfaces += static_cast<uint32_t>(model.surfaces.size());
    out.primitives += static_cast<uint32_t>(model.triangles.size());
  }
  return out;
}

}  // namespace

struct Simulation::State {
  Config config;
  TraceConfig trace;  // of it, without what the scene does not need
  StageSeconds setup;
  std::optional<gpu::Context> context;
  Scene scene;
  std::optional<Surroundings> around;  // of places in the scene
  DeviceScene device_scene;
  std::optional<World> world;
  Origins origins;
  std::optional<InstancePlacement> place;  // where there are instances
  bool reuse = false;
  uint64_t warm_frames = 0;  // since the last cold one, which counts
  std::optional<LaunchSides> launch_sides;
  std::optional<LaunchSlopes> slopes;  // with trace.directions = "horizon"
  std::optional<RayTrails> trails;     // with trace.reception = "sphere" or output.waypoints
  std::optional<Discovery> discovery;
  std::optional<ExactPaths> exact_paths;
  std::optional<FieldModel> fields;
  DeviceSummary device;
  OrderSummary order;
  Features features;
  std::vector<std::string> place_warnings;

  FrameWatch frame_watch;

  bool compiling = false;  // launches are there to be compiled

  LeftOut left_out;  // of the last frame, which is told once the names of its ends are known

  FrameResult solve(uint32_t frame, WorldState frame_world, const LinkBlock* block = nullptr);
  FrameResult watched(uint32_t frame, WorldState frame_world, const LinkBlock* block = nullptr);
  void compile_launches();
  void forget();
  void warn_of_near_ends(FrameResult& result) const;
  void begin_frame();
  DiscoveryCounts discover(const WorldState& state, const LinkBlock* block);
  PathGeometry received_paths(const RadioEnds& ends, FrameCounts& counts, Stopwatch& host);
};

// A cold frame starts from nothing; others go on with the sequences that are still met.
void Simulation::State::begin_frame() {
  Sequences& sequences = discovery->sequences();
  if (!reuse) warm_frames = 0;
  if (warm_frames == 0) sequences.clear();
  sequences.begin_frame();
  if (warm_frames > 0 && warm_frames % config.trace.forget_frames == 0)
    sequences.forget(config.trace.forget_frames, config.trace.max_depth);
}

// With diffraction listeners launch too, and what both ends see meets at the edge.
DiscoveryCounts Simulation::State::discover(const WorldState& state, const LinkBlock* block) {
  std::vector<Launcher> first = sending(state), then;
  if (trace.diffraction) then = listening(state, origins);
  if (block) {
    first = launchers_of(*block, first);
    then = launchers_of(*block, then);
  }
  if (compiling) {
    first.resize(std::min<size_t>(first.size(), 1));
    then.resize(std::min<size_t>(then.size(), 1));
  }
  if (!trails) {  // which follow one launch a transmitter
    first = launch_sides->of(first, state);
    then = launch_sides->of(then, state);
  }
  if (slopes) {
    const SlopeTables tables = (*slopes)(state, origins);
    for (std::vector<Launcher>* const launchers : {&first, &then})
      for (Launcher& launcher : *launchers) launcher.heights = tables.of_origin[launcher.transmitter];
    discovery->set_heights(tables.values);
  }
  if (!trace.rays) {
    first.insert(first.end(), then.begin(), then.end());
    return discovery->refined(device_scene, first, warm_frames);
  }
  const auto share = [this](uint64_t rays, std::optional<uint64_t> refresh_rays) {
    return compiling ? DirectionShare{0, std::max<uint64_t>(rays / compiling_rays, 1)}
                     : share_of(rays, refresh_rays, warm_frames);
  };
  DiscoveryCounts counts = (*discovery)(device_scene, first, share(*trace.rays, trace.refresh_rays));
  if (!then.empty())
    add((*discovery)(device_scene, then, share(listener_rays(trace), {}), LaunchedBy::listeners), counts);
  return counts;
}

void Simulation::State::forget() {
  warm_frames = 0;
  if (RayCache* const cache = discovery->cache()) cache->clear();
}

// PoCL compiles a kernel for the shape of its first launch, which would take most of the first frame. So what a frame
// launches is launched before, by few rays of one transmitter, and forgotten.
void Simulation::State::compile_launches() {
  if (!context->info().cpu) return;
  compiling = true;
  solve(0, world->state(0));
  compiling = false;
  forget();
}

void Simulation::State::warn_of_near_ends(FrameResult& result) const {
  const auto name = [](const std::vector<RadioEnd>& ends) { return [&](uint32_t end) { return ends[end].name; }; };
  if (!left_out.empty())
    result.warnings.push_back(left_out_warning(left_out, name(config.transmitters), name(config.receivers)));
}

// The thesis' way: rays that pass a receiver's sphere are its paths. Leaves `host` at the time since the device was
// done.
PathGeometry Simulation::State::received_paths(const RadioEnds& ends, FrameCounts& counts, Stopwatch& host) {
  counts.sequences = discovery->sequences().collect(ends.transmitter_count) - ends.transmitter_count;
  counts.receptions = trails->receptions();
  host.lap();
  return distinct_paths(trails->paths());
}

Simulation::Simulation(const Config& config, const std::string& device) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.config = config;
  Stopwatch watch;
  s.context.emplace(device);
  const gpu::DeviceInfo& info = s.context->info();
  s.device = {info.platform, info.name, info.driver, info.opencl_c, info.gpu};
  s.setup["device"] = watch.lap();
  s.scene = load_scene(config);
  s.setup["load"] = watch.lap();
  s.world.emplace(config, s.scene);
  s.around.emplace(s.scene);
  s.place_warnings = wavetracer::place_warnings(config, *s.around, *s.world);
  s.config.transmitters = s.world->transmitters();
  s.config.receivers = s.world->receivers();
  s.features = choose_features(s.config, s.scene, *s.world);
  s.trace = with_features(s.config.trace, s.features);
  s.origins = make_origins(s.world->receiver_of_transmitter(), s.world->transmitter_of_receiver(), s.trace.diffraction);
  const std::vector<glm::dvec3> transmitters = positions(s.world->state(0).transmitters);
  s.device_scene = choose_tree(*s.context, s.scene, config.trace, transmitters, s.world->reach_m());
  if (!s.world->instances().empty()) {
    s.place.emplace(*s.context, s.world->models(), s.world->instances(), s.device_scene);
    (*s.place)(s.device_scene, s.world->state(0).instances);
  }
  if (s.trace.transmission)
    mark_opaque(s.device_scene,
                opaque_surfaces(s.scene, s.world->models(), s.world->instances(), config.radio.frequency_hz));
  s.launch_sides.emplace(s.scene, s.world->models(), s.world->instances());
  s.setup["build"] = watch.lap();
  OrderChoice order;
  if (config.order.method == "auto") {
    order = choose_order(*s.context, s.scene, s.device_scene, config, transmitters);
    s.setup["order"] = watch.lap();
  } else {
    order.plan = plan_order(config.order, config.launch);
  }
  s.order = {order.plan.method, order.plan.each_depth, std::to_string(order.plan.launch.dimensions) + "d",
             order.plan.launch.local_size, order.reason};
  const bool sphere = config.trace.reception == "sphere";
  // A sphere receives what this frame's rays meet.
  s.reuse = config.trace.reuse && !sphere && (s.world->frame_count() > 1 || s.world->live());
  if (s.trace.directions == "horizon") s.slopes.emplace(*s.around, s.world->reach_m());
  s.discovery.emplace(*s.context, s.device_scene, s.trace, order.plan, s.reuse);
  if (s.trace.diffraction && s.trace.rays) s.discovery->listen(listener_rays(s.trace));
  if (sphere || config.output.waypoints > 0) {
    s.trails.emplace(*s.context, s.trace, config.output.waypoints, s.trace.reflection ? s.trace.max_depth : 0,
                     SurfaceTable(s.scene, s.world->models(), s.world->instances()));
    s.discovery->follow(*s.trails);
  }
  if (config.cache.kind != "none") {
    s.discovery->use_cache(s.device_scene, config.cache, cache_world(s.scene, *s.world, s.origins));
    if (sphere) s.discovery->cache()->keep_receptions(*s.trails, config.trace.sphere_radius_m);
  }
  s.exact_paths.emplace(*s.context, s.device_scene, s.scene, *s.world, s.trace, s.origins);
  Config radio = s.config;
  radio.trace = s.trace;
  s.fields.emplace(s.scene, radio, s.world->models(), s.world->instances());
  s.compile_launches();
  s.discovery->watch(s.frame_watch);
  s.exact_paths->watch(s.frame_watch);
  s.setup["compile"] = watch.lap();
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::observe(FrameObserver observer) { state_->frame_watch.set(std::move(observer)); }
void Simulation::forget() { state_->forget(); }
uint64_t Simulation::frame_count() const { return state_->world->frame_count(); }
double Simulation::time_s(uint32_t frame) const { return state_->world->time_s(frame); }
const Config& Simulation::config() const { return state_->config; }
const std::vector<Instance>& Simulation::instances() const { return state_->world->instances(); }
const std::vector<Scene>& Simulation::models() const { return state_->world->models(); }
const Scene& Simulation::scene() const { return state_->scene; }
std::vector<std::string> Simulation::warnings() const {
  std::vector<std::string> out = state_->scene.report.warnings;
  for (const std::vector<std::string>* more : {&state_->world->warnings(), &std::as_const(state_->place_warnings)})
    out.insert(out.end(), more->begin(), more->end());
  return out;
}

MissingLinks Simulation::explain_missing(const FrameResult& frame) const {
  const State& s = *state_;
  const Paths& paths = frame.paths;
  size_t found = 0;  // links that have a path; rows of a link are neighbours
  for (size_t i = 0; i < paths.size(); ++i)
    found += i == 0 || paths.tx[i] != paths.tx[i - 1] || paths.rx[i] != paths.rx[i - 1];
  if (found == frame.world.links.size()) return {};
  return wavetracer::explain_missing(s.config, s.features, *s.around, *s.world, frame);
}

const DeviceSummary& Simulation::device() const { return state_->device; }
const OrderSummary& Simulation::order() const { return state_->order; }
const Features& Simulation::features() const { return state_->features; }
const StageSeconds& Simulation::setup_seconds() const { return state_->setup; }

FrameResult Simulation::run_frame(uint32_t frame) {
  Stopwatch watch;
  WorldState world = state_->world->state(frame);
  const double poses_seconds = watch.lap();
  FrameResult out = state_->watched(frame, std::move(world));
  state_->warn_of_near_ends(out);
  out.seconds["poses"] = poses_seconds;
  out.seconds["frame"] += poses_seconds;
  return out;
}

std::string block_obstacle(const Config& config) {
  if (!config.trace.rays) return "trace.rays = \"auto\" looks at the rays of all transmitters together";
  if (config.trace.reception != "exact") return "trace.reception = \"" + config.trace.reception.text() + "\"";
  if (config.cache.kind != "none") return "all transmitters share one ray cache (cache.kind)";
  if (config.output.waypoints > 0) return "output.waypoints follows the rays of all transmitters";
  return {};
}

FrameResult Simulation::run_block(uint32_t frame, TransmitterRange transmitters) {
  State& s = *state_;
  if (const std::string why = block_obstacle(s.config); !why.empty())
    throw ConfigError("a frame of this configuration cannot be cut into blocks of transmitters: " + why);
  forget();
  Stopwatch watch;
  WorldState world = s.world->state(frame);
  const LinkBlock block = make_link_block(world.links, transmitters, s.world->receiver_of_transmitter(),
                                          s.world->transmitter_of_receiver(), s.origins);
  const double poses_seconds = watch.lap();
  FrameResult out = s.watched(frame, std::move(world), &block);
  s.warn_of_near_ends(out);
  forget();
  out.seconds["poses"] = poses_seconds;
  out.seconds["frame"] += poses_seconds;
  return out;
}

LiveFrame Simulation::run_poses(LiveTraffic& traffic, double time_s, std::span<const LivePose> poses) {
  Stopwatch watch;
  WorldState world = state_->world->live_state(traffic, time_s, poses);
  const double poses_seconds = watch.lap();
  LiveFrame out;
  out.result = state_->solve(traffic.frames++, std::move(world));
  out.result.seconds["poses"] = poses_seconds;
  out.result.seconds["frame"] += poses_seconds;
  state_->world->set_names(traffic, out);
  const auto name = [](const std::vector<std::string>& names) { return [&](uint32_t end) { return names[end]; }; };
  if (!state_->left_out.empty())
    out.result.warnings.push_back(left_out_warning(state_->left_out, name(out.transmitters), name(out.receivers)));
  return out;
}

const std::vector<LiveType>& Simulation::live_types() const { return state_->world->live_types(); }
const LiveBounds& Simulation::live_bounds() const { return state_->world->live_bounds(); }

// A frame that is given up leaves half of its sequences, which the next one must not take for all.
FrameResult Simulation::State::watched(uint32_t frame, WorldState frame_world, const LinkBlock* block) {
  try {
    return solve(frame, std::move(frame_world), block);
  } catch (const FrameStopped&) {
    forget();
    throw;
  }
}

// One frame of this world, from poses to fields. block: the links of it alone.
FrameResult Simulation::State::solve(uint32_t frame, WorldState frame_world, const LinkBlock* block) {
  FrameResult out;
  out.frame = frame;
  context->reset_profile();
  Stopwatch watch, host_watch;

  out.world = std::move(frame_world);
  if (place) (*place)(device_scene, out.world.instances);
  const std::vector<Link>& links = block ? block->solved : out.world.links;
  const RadioEnds ends =
      make_radio_ends(*context, out.world.transmitters, out.world.receivers, links, origins.listeners);
  begin_frame();
  RayCache* const cache = discovery->cache();
  if (cache) cache->begin_frame(out.world);
  if (trails) trails->begin_frame(frame, ends, out.world);
  const DiscoveryCounts found = discover(out.world, block);
  if (cache) out.cache = cache->summary();
  if (trails) out.waypoints = trails->take_waypoints();
  const bool sphere = trails && trails->receives();
  PathGeometry one_way = sphere ? received_paths(ends, out.counts, host_watch)
                                : (*exact_paths)(device_scene, ends, discovery->sequences(), out.counts, host_watch);
  PathGeometry geometry = with_reversed_twins(std::move(one_way), world->receiver_of_transmitter(),
                                              world->transmitter_of_receiver(), links);
  if (block) {
    geometry = paths_of(*block, geometry);
    out.world.links = block->own;
  }

  const double paths_seconds = host_watch.lap();
  if (sphere || cache) geometry.quarters.clear();  // what they find, no smaller launch tells of
  out.paths = fields->compute(frame, std::move(geometry), out.world, &left_out);
  if (found.rays > 0) out.missed = missed_counts(out.paths, 0, out.paths.size());
  out.warnings = missed_recall(found, config.trace, warm_frames++ == 0, out.missed);
  const double fields_seconds = host_watch.lap(), frame_seconds = watch.lap();

  out.seconds = context->profile();
  out.seconds["paths"] = paths_seconds;
  out.seconds["fields"] = fields_seconds;
  out.seconds["frame"] = frame_seconds;
  out.segments_per_depth = found.segments_per_depth;
  out.counts.rays = found.rays;
  for (const uint64_t segments : found.segments_per_depth) out.counts.segments += segments;
  out.counts.hits = found.hits;
  out.counts.paths = out.paths.size();
  return out;
}

}  // namespace wavetracer
