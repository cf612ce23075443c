// The public entry of libwavetracer: a scene on a device, solved frame by frame.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "wavetracer/config.hpp"
#include "wavetracer/features.hpp"
#include "wavetracer/frame_result.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// How far a frame is: `done` of `total` of what the stage counts.
struct FrameProgress {
  std::string stage;  // "rays" (those that were launched), then "paths" (steps of the exact solution)
  uint64_t done = 0, total = 0;
};
// Is told between batches of rays and between these steps; where it returns false, the frame is given up.
using FrameObserver = std::function<bool(const FrameProgress&)>;

// What run_frame() throws where the observer wanted no more of it. The simulation can go on with any frame.
class FrameStopped : public std::runtime_error {
 public:
  FrameStopped() : std::runtime_error("the frame was given up") {}
};

// Transmitters first to end - 1.
struct TransmitterRange {
  uint32_t first = 0, end = 0;
};

// Why frames of this configuration cannot be cut into blocks of transmitters; empty where they can.
std::string block_obstacle(const Config& config);

// Of a live world, see wavetracer/live.hpp.
struct LiveBounds;
struct LiveFrame;
struct LivePose;
struct LiveTraffic;
struct LiveType;

class Simulation {
 public:
  // Loads the scene, builds surfaces and acceleration structures, compiles the kernels.
  // device: text that matches a platform or device name, an index, or empty for the default choice.
  // Throws ConfigError, InputError or DeviceError.
  Simulation(const Config& config, const std::string& device = "");
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  // Frames of one drive may be asked for in any order; with trace.reuse, what a frame finds depends on the frames since
  // the last forget(). Throws ConfigError for a frame that the world does not have.
  FrameResult run_frame(uint32_t frame);
  // The links of these transmitters alone, as run_frame() finds them, bit for bit: nothing of earlier frames is reused,
  // and counts are of the work that was done, which the rays of other ends are part of. Throws ConfigError where the
  // configuration couples all transmitters, see block_obstacle().
  FrameResult run_block(uint32_t frame, TransmitterRange transmitters);
  // A frame of poses that come at run time, in a world with [[live_vehicle]]. Updates the traffic. Throws PoseError,
  // which leaves all as it was, and ConfigError where there is no [[live_vehicle]].
  LiveFrame run_poses(LiveTraffic& traffic, double time_s, std::span<const LivePose> poses);
  const std::vector<LiveType>& live_types() const;
  const LiveBounds& live_bounds() const;
  // Of all frames that follow; an empty one is told nothing.
  void observe(FrameObserver observer);
  // Drops all sequences of earlier frames, and what a ray cache holds: the next frame is cold.
  void forget();
  uint64_t frame_count() const;
  double time_s(uint32_t frame) const;
  const Scene& scene() const;
  // The configuration with the ends that are mounted on vehicles among its transmitters and receivers.
  const Config& config() const;
  const std::vector<Instance>& instances() const;
  const std::vector<Scene>& models() const;
  // Why links of a frame have no path: what their direct lines meet first, and which mechanism that is off may bring
  // something. It costs a pass over the scene.
  MissingLinks explain_missing(const FrameResult& frame) const;
  // What loading the scene and the trajectories left out or made up; antennas and vehicles in places that cannot be
  // meant.
  std::vector<std::string> warnings() const;
  const DeviceSummary& device() const;
  const OrderSummary& order() const;
  const Features& features() const;
  // Stages outside the frame: load, surfaces, build, compile, ...
  const StageSeconds& setup_seconds() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer
