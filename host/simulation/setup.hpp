// What a simulation is made of: made once, in this order, and complete once it is constructed.
// Members refer to those before them.
#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "base/stopwatch.hpp"
#include "simulation/discovery.hpp"
#include "simulation/element_outputs.hpp"
#include "simulation/exact_paths.hpp"
#include "simulation/finished_paths.hpp"
#include "simulation/frame_watch.hpp"
#include "simulation/launch_sides.hpp"
#include "simulation/launch_slopes.hpp"
#include "simulation/launch_windows.hpp"
#include "simulation/listeners.hpp"
#include "simulation/order_choice.hpp"
#include "simulation/placement.hpp"
#include "simulation/ray_cache.hpp"
#include "simulation/ray_trails.hpp"
#include "simulation/surroundings.hpp"
#include "simulation/world.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer {

struct Setup {
  // As Simulation::Simulation; the device has proved itself then (device_proof.hpp). frames_follow: frames of poses of
  // the caller's own follow each other, also where the world has one frame; then they reuse sequences if trace.reuse
  // says so.
  Setup(const Config& asked, const std::string& device_text, bool frames_follow = false);
  // A scene of the caller's own on a device that need not have proved itself: it is what the proof is made with. The
  // context outlives this.
  Setup(gpu::Context& context, const Config& asked, const Scene& scene, bool frames_follow);
  Setup(const Setup&) = delete;
  Setup& operator=(const Setup&) = delete;

  // The time since the end of the last stage belongs to this one of `seconds`.
  void end_stage(const char* name) { seconds[name] += watch.lap(); }
  // Is there anything that rays might meet?
  bool has_surfaces() const { return !scene.surfaces.empty() || !world.fleet.instances.empty(); }

  Stopwatch watch;
  StageSeconds seconds;
  std::unique_ptr<gpu::Context> own_context;  // null where the caller lends one
  gpu::Context& context;
  DeviceSummary device;
  Scene scene;
  World world;
  Surroundings around;  // of places in the scene
  std::vector<std::string> place_warnings;
  Config config;  // as it was given, with all ends of the world
  Features features;
  TraceConfig trace;  // without what the scene does not need
  Origins origins;
  DeviceScene device_scene;
  std::optional<InstancePlacement> placement;  // where there are instances
  LaunchSides launch_sides;
  OrderChoice order;
  OrderSummary order_summary;
  bool reuse;                          // whether frames reuse the sequences of earlier frames
  std::optional<LaunchSlopes> slopes;  // with trace.directions = "horizon"
  std::optional<RayTrails> trails;     // with trace.reception = "sphere" or output.waypoints
  // For ends far outside of the scene; not with spheres, which rays must meet wherever they are.
  std::optional<LaunchWindows> windows;
  std::optional<RayCache> cache;  // with cache.kind
  FrameWatch frame_watch;
  Discovery discovery;
  ExactPaths exact_paths;
  FinishedPaths finish;
  ElementOutputs elements;

 private:
  Setup(std::unique_ptr<gpu::Context> own, gpu::Context* lent, const Config& asked, const std::function<Scene()>& load,
        bool frames_follow);
};

}  // namespace wavetracer
