// SPDX-License-Identifier: Apache-2.0
// Simulation: the public interface of setup and frames.
#include "wavetracer/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "config/contradictions.hpp"
#include "gradient/frame_gradient.hpp"
#include "simulation/batched_frames.hpp"
#include "simulation/missing_paths.hpp"
#include "simulation/world_motion.hpp"
#include "wavetracer/arrays.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/live.hpp"

namespace wavetracer {

struct Simulation::State {
  State(const Config& asked, const std::string& device_text, const FramesPlanned& planned)
      : setup(make_setup(asked, device_text, false, check_of(planned))), frames(setup) {}

  static PlanCheck check_of(const FramesPlanned& planned) {
    if (!planned) return {};
    return [&planned](const RunPlan& plan) { planned(plan.world.clock.frame_count()); };
  }

  const RunPlan& plan() const { return *setup.plan; }

  FrameNames names() const { return FrameNames::of(plan().asked); }

  // Makes the task of a frame of the drive, for links that may be a part of them.
  BatchedFrames::TaskOf tasks(uint32_t frame, bool profiled) const {
    return [this, frame, profiled](const LinkPart& links) {
      return FrameTask::of_drive({.frame = frame,
                                  .pose = [this, frame] { return plan().world.state(frame); },
                                  .names = names(),
                                  .timed = profiled,
                                  .as_planned = true},
                                 links);
    };
  }

  // Runs a frame of a live world. pose: gives the world, and sets the names in the frame; task: makes its task.
  LiveFrame live_frame(uint32_t frame, const std::function<WorldState(LiveNames&)>& pose,
                       const std::function<FrameTask(FrameInput)>& task) {
    LiveFrame out;
    out.result = frames.loop().run(task({.frame = frame,
                                         .pose = [&] { return pose(out); },
                                         .names = {[&](uint32_t end) { return out.transmitters[end]; },
                                                   [&](uint32_t end) { return out.receivers[end]; }},
                                         .timed = timed()}));
    return out;
  }

  // Is the next frame profiled?
  bool timed() {
    const uint64_t run = runs++;
    return run < 3 || run % profile_every == 0;
  }

  Setup setup;
  BatchedFrames frames;
  std::optional<FrameGradient> gradient;  // made at its first use
  uint32_t profile_every = 1;
  uint64_t runs = 0;
};

Simulation::Simulation(const Config& config, const std::string& device, const FramesPlanned& planned)
    : state_(std::make_unique<State>(config, device, planned)) {}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

void Simulation::observe(FrameObserver observer) { state_->setup.frame_watch->set(std::move(observer)); }
void Simulation::profile_every(uint32_t frames) { state_->profile_every = std::max(frames, 1u); }
void Simulation::give_back(FrameResult& result) {
  state_->setup.finish.give_room(std::exchange(result.paths, Paths()));
  if (result.summed) state_->frames.loop().give_room(std::move(result.summed->links));
  result.summed.reset();
}
void Simulation::sum_links(bool on) { state_->frames.sum_links(on); }
void Simulation::forget() { state_->frames.loop().forget(); }
uint64_t Simulation::frame_count() const { return state_->plan().world.clock.frame_count(); }
double Simulation::time_s(uint32_t frame) const { return state_->plan().world.clock.time_s(frame); }
const Config& Simulation::config() const { return state_->plan().asked; }
const std::vector<Instance>& Simulation::instances() const { return state_->plan().world.fleet.instances; }
std::vector<SensedTarget> Simulation::targets() const {
  std::vector<SensedTarget> out;
  for (const Target& target : state_->plan().world.targets.all)
    out.push_back({target.name, target.model, target.instance});
  return out;
}
const std::vector<Scene>& Simulation::models() const { return state_->plan().world.fleet.models; }
const Scene& Simulation::scene() const { return state_->plan().scene; }
std::vector<std::string> Simulation::warnings() const {
  const Setup& s = state_->setup;
  const RunPlan& plan = *s.plan;
  std::vector<std::string> out = plan.scene.report.warnings;
  if (s.cache && s.cache->as_printed())
    out.push_back(fmt::format(
        "cache.kind = \"{}\" is the table as A. Zhdanov's thesis prints it, with its faults: rays get results of "
        "others, so that paths are missing{}; it is for comparison, and \"{}\" is the table without them",
        plan.asked.cache.kind.text(), plan.asked.trace.by_spheres() ? " or wrong" : "",
        plan.asked.cache.linked() ? "chained" : "open"));
  if (frame_count() > 1 && !plan.world.live)
    if (const auto text = unmeasured_warning(plan.trace.discover_every_s, plan.world.clock.step_s(), frame_count(),
                                             plan.asked.output.shard_frames))
      out.push_back(*text);
  for (std::string& idle : config::idle_settings(plan.asked)) out.push_back(std::move(idle));
  for (const std::vector<std::string>* more : {&plan.world.warnings, &s.place_warnings})
    out.insert(out.end(), more->begin(), more->end());
  for (const std::string& note : s.context.notes()) out.push_back(note);
  return out;
}

MissingLinks Simulation::explain_missing(const FrameResult& frame) const {
  const RunPlan& plan = state_->plan();
  if (links_without_path(frame).empty()) return {};
  return wavetracer::explain_missing(plan.asked, plan.features, *state_->setup.around, plan.world, frame);
}

PathGradients Simulation::gradient(const FrameResult& frame, const GradientChoice& choice) {
  if (frame.summed)
    throw ConfigError("the frame has sums of links and no paths (Simulation::sum_links), so there are no derivatives");
  const RunPlan& plan = state_->plan();
  if (!state_->gradient)
    state_->gradient.emplace(plan.scene, plan.computed(), plan.world.fleet.models, plan.world.fleet.instances);
  return (*state_->gradient)(frame, choice);
}

std::vector<RadarRows> Simulation::radars(const FrameResult& frame, bool with_cubes) const {
  if (frame.summed)
    throw ConfigError("the frame has sums of links and no paths (Simulation::sum_links), so radars receive nothing");
  return state_->setup.elements.radars(frame, with_cubes ? CubesKept::all : CubesKept::none);
}

uint64_t Simulation::radar_cells(const FrameResult& frame) const {
  return state_->setup.elements.radar_cells(frame, CubesKept::all);
}

std::vector<RadarAxes> Simulation::radar_axes() const {
  std::vector<RadarAxes> out;
  for (const WorldRadar& radar : state_->plan().radars) out.push_back(radar.axes);
  return out;
}

const DeviceSummary& Simulation::device() const { return state_->setup.device; }
const OrderSummary& Simulation::order() const { return state_->setup.order_summary; }
const Features& Simulation::features() const { return state_->plan().features; }
double Simulation::diffraction_range_db() const { return state_->plan().trace.diffraction_range_db.value_or(0); }
uint64_t Simulation::edge_rays() const {
  const TraceConfig& trace = state_->plan().trace;
  return trace.from_edges() ? *trace.edge_rays : 0;
}
const StageSeconds& Simulation::setup_seconds() const { return state_->setup.stages.seconds(); }

FrameResult Simulation::run_frame(uint32_t frame) {
  return state_->frames.run(state_->tasks(frame, state_->timed()), LinkPart());
}

FrameResult Simulation::run_time(double time_s, const std::vector<Link>* only) {
  const RunPlan& plan = state_->plan();
  const double first_s = plan.world.clock.time_s(0), last_s = plan.world.clock.time_s(frame_count() - 1);
  if (!(time_s >= first_s && time_s <= last_s))
    throw ConfigError(
        fmt::format("the drive has frames from {} to {} s, and none can be computed at {} s", first_s, last_s, time_s));
  if (!plan.trace.by_beams())
    throw ConfigError("times between frames are computed by beams alone: set trace.discovery = \"beams\"");
  const auto pose = [&] {
    WorldState state = plan.world.at(time_s);
    if (only) std::erase_if(state.links, [&](const Link& link) { return !std::ranges::binary_search(*only, link); });
    return state;
  };
  return state_->frames.run(
      [&](const LinkPart& links) {
        return FrameTask::of_drive({.frame = 0, .pose = pose, .names = state_->names(), .timed = state_->timed()},
                                   links);
      },
      LinkPart());
}

double Simulation::motion_m(double from_s, double to_s) const {
  return motion_bound_m(state_->plan().world, from_s, to_s);
}

std::string block_obstacle(const Config& config) {
  if (!config.trace.rays) return "trace.rays = \"auto\" looks at the rays of all transmitters together";
  if (config.trace.by_spheres()) return "trace.reception = \"" + config.trace.reception.text() + "\"";
  if (config.cache.on()) return "all transmitters share one ray cache (cache.kind)";
  if (config.output.waypoints > 0) return "output.waypoints follows the rays of all transmitters";
  return {};
}

FrameResult Simulation::run_block(uint32_t frame, TransmitterRange transmitters) {
  if (const std::string why = block_obstacle(config()); !why.empty())
    throw ConfigError("a frame of this configuration cannot be cut into blocks of transmitters: " + why);
  return state_->frames.run(state_->tasks(frame, true), LinkPart(transmitters));
}

LiveFrame Simulation::run_poses(LiveTraffic& traffic, double time_s, std::span<const LivePose> poses) {
  const auto pose = [&](LiveNames& names) {
    const World& world = state_->plan().world;
    const std::vector<PlacedPose> placed = world.live_places().place(traffic, time_s, poses);
    WorldState state = world.state(time_s, placed);
    ++traffic.frames;
    names = world.names(placed);
    return state;
  };
  return state_->live_frame(traffic.frames, pose,
                            [&](FrameInput input) { return FrameTask::of_poses(std::move(input), traffic.discovery); });
}

LiveFrame Simulation::run_between(const LiveTraffic& traffic, double time_s) {
  const auto pose = [&](LiveNames& names) {
    const World& world = state_->plan().world;
    const std::vector<PlacedPose> placed = world.live_places().between(traffic, time_s);
    names = world.names(placed);
    return world.state(time_s, placed);
  };
  return state_->live_frame(traffic.frames, pose, [&](FrameInput input) {
    return FrameTask::between_poses(std::move(input), traffic.discovery);
  });
}

const std::vector<LiveType>& Simulation::live_types() const { return state_->plan().world.live_places().types(); }
const LiveBounds& Simulation::live_bounds() const { return state_->plan().world.live_places().bounds(); }

ElementModel::ElementModel(const Simulation& simulation)
    : ElementModel(simulation.config(), simulation.scene(), simulation.models(), simulation.instances()) {}

}  // namespace wavetracer
