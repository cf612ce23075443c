// Simulation: a scene on a device, solved frame by frame. run_frame is the main loop of the program.
// Rays discover, geometry decides: see docs/architecture.md.
#include "wavetracer/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "passes/candidates.hpp"
#include "passes/occlusion.hpp"
#include "passes/solve.hpp"
#include "radio/fields.hpp"
#include "scene/load.hpp"
#include "simulation/discovery.hpp"
#include "simulation/order_choice.hpp"
#include "simulation/stopwatch.hpp"
#include "simulation/tree_choice.hpp"
#include "simulation/visible_paths.hpp"
#include "simulation/world.hpp"

namespace wavetracer {

namespace {

std::vector<glm::dvec3> positions(const std::vector<EndState>& ends) {
  std::vector<glm::dvec3> out;
  for (const EndState& end : ends) out.push_back(end.position_m);
  return out;
}

}  // namespace

struct Simulation::State {
  Config config;
  StageSeconds setup;
  std::optional<gpu::Context> context;
  Scene scene;
  DeviceScene device_scene;
  std::optional<World> world;
  std::optional<Discovery> discovery;
  std::optional<Candidates> candidates;
  std::optional<Solve> solve;
  std::optional<Occlusion> occlusion;
  std::optional<FieldModel> fields;
  DeviceSummary device;
  OrderSummary order;
};

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
  s.config.transmitters = s.world->transmitters();
  s.config.receivers = s.world->receivers();
  const std::vector<glm::dvec3> transmitters = positions(s.world->state(0).transmitters);
  s.device_scene = choose_tree(*s.context, s.scene, config.trace, transmitters, s.world->reach_m());
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
  s.discovery.emplace(*s.context, s.device_scene, config.trace, order.plan);
  s.candidates.emplace(*s.context);
  s.solve.emplace(*s.context, config.trace.max_depth);
  s.occlusion.emplace(*s.context, s.device_scene);
  s.fields.emplace(s.scene, s.config);
  s.setup["compile"] = watch.lap();
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::forget() {}
uint64_t Simulation::frame_count() const { return state_->world->frame_count(); }
double Simulation::time_s(uint32_t frame) const { return state_->world->time_s(frame); }
const Config& Simulation::config() const { return state_->config; }
const std::vector<Instance>& Simulation::instances() const { return state_->world->instances(); }
const std::vector<Scene>& Simulation::models() const { return state_->world->models(); }
const Scene& Simulation::scene() const { return state_->scene; }
const DeviceSummary& Simulation::device() const { return state_->device; }
const OrderSummary& Simulation::order() const { return state_->order; }
const StageSeconds& Simulation::setup_seconds() const { return state_->setup; }

FrameResult Simulation::run_frame(uint32_t frame) {
  State& s = *state_;
  FrameResult out;
  out.frame = frame;
  out.world = s.world->state(frame);
  s.context->reset_profile();
  Stopwatch watch;

  const std::vector<glm::dvec3> transmitters = positions(out.world.transmitters);
  const RadioEnds ends = make_radio_ends(*s.context, transmitters, positions(out.world.receivers));
  const DiscoveryCounts found = (*s.discovery)(s.device_scene, transmitters);
  Sequences& sequences = s.discovery->sequences();
  uint32_t node_count = sequences.collect(ends.transmitter_count);
  sequences.commute(s.device_scene.surfaces, node_count, s.config.trace.max_depth);
  node_count = sequences.collect(ends.transmitter_count);
  const uint32_t candidate_count =
      (*s.candidates)(s.device_scene, ends, sequences.table(), sequences.nodes(), node_count, sequences.counters());
  SolvedList& solved = (*s.solve)(s.device_scene, ends, sequences.table(), s.candidates->list(), candidate_count,
                                  sequences.counters());
  (*s.occlusion)(s.device_scene, ends, solved);
  const PathGeometry geometry = visible_paths(solved);

  Stopwatch fields_watch;
  out.paths = s.fields->compute(frame, geometry);
  const double fields_seconds = fields_watch.lap(), frame_seconds = watch.lap();

  out.seconds = s.context->profile();
  out.seconds["fields"] = fields_seconds;
  out.seconds["frame"] = frame_seconds;
  out.segments_per_depth = found.segments_per_depth;
  out.counts.rays = found.rays;
  for (const uint64_t segments : found.segments_per_depth) out.counts.segments += segments;
  out.counts.hits = found.hits;
  out.counts.sequences = node_count - ends.transmitter_count;
  out.counts.candidates = candidate_count;
  out.counts.solved = solved.count;
  out.counts.paths = out.paths.size();
  return out;
}

}  // namespace wavetracer
