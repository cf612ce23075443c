// SPDX-License-Identifier: Apache-2.0
// The parts of a simulation: the plan of the run, and the objects that compute it on a device.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/stopwatch.hpp"
#include "lifetime/path_lifetimes.hpp"
#include "simulation/beam_tracing.hpp"
#include "simulation/discovery.hpp"
#include "simulation/element_outputs.hpp"
#include "simulation/exact_paths.hpp"
#include "simulation/finished_paths.hpp"
#include "simulation/frame_watch.hpp"
#include "simulation/launch_sides.hpp"
#include "simulation/launch_slopes.hpp"
#include "simulation/launch_windows.hpp"
#include "simulation/order_choice.hpp"
#include "simulation/placement.hpp"
#include "simulation/ray_cache.hpp"
#include "simulation/ray_trails.hpp"
#include "simulation/run_plan.hpp"
#include "simulation/surroundings.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

// The stages outside of frames, and how long each took.
class StageClock {
 public:
  // The time since the end of the last stage belongs to this one.
  void end(const char* name) { seconds_[name] += watch_.lap(); }
  const StageSeconds& seconds() const { return seconds_; }

 private:
  Stopwatch watch_;
  StageSeconds seconds_;
};

// A value whose parts may be moved: what others refer to is on the heap.
struct Setup {
  StageClock stages;
  std::unique_ptr<gpu::Context> own_context;  // null where the caller lends one
  gpu::Context& context;
  DeviceSummary device;
  std::unique_ptr<const RunPlan> plan;
  std::unique_ptr<const Surroundings> around;  // surroundings of places in the scene
  std::vector<std::string> place_warnings;
  DeviceScene device_scene;
  std::optional<InstancePlacement> placement;  // only if there are instances
  LaunchSides launch_sides;
  OrderChoice order;
  OrderSummary order_summary;
  std::optional<LaunchSlopes> slopes;  // with trace.directions = "horizon"
  std::unique_ptr<RayTrails> trails;   // with trace.reception = "sphere" or output.waypoints, else null
  // For ends far outside of the scene; not with spheres, which rays must meet wherever they are.
  std::optional<LaunchWindows> windows;
  std::unique_ptr<RayCache> cache;  // with cache.kind, else null
  std::unique_ptr<FrameWatch> frame_watch;
  std::unique_ptr<Discovery> discovery;
  std::unique_ptr<BeamTracing> beams;  // with trace.discovery = "beams", else null
  ExactPaths exact_paths;
  FinishedPaths finish;
  ElementOutputs elements;
  std::unique_ptr<const PathLifetimes> lifetimes;  // with output.lifetimes, else null
};

// Refuses a plan by an exception, before kernels are compiled for it. It may be empty.
using PlanCheck = std::function<void(const RunPlan&)>;

// As Simulation::Simulation; the device has proved itself then (device_proof.hpp). frames_follow: see plan_run().
Setup make_setup(const Config& asked, const std::string& device_text, bool frames_follow = false,
                 const PlanCheck& check = {});
// A scene of the caller's own on a device that need not have proved itself: it is what the proof is made with. The
// context outlives what is returned.
Setup make_setup(gpu::Context& context, const Config& asked, const Scene& scene, bool frames_follow);

}  // namespace wavetracer
