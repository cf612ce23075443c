// The public entry of libwavetracer: a scene on a device, solved frame by frame.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>
#include "wavetracer/config.hpp"
#include "wavetracer/missed.hpp"
#include "wavetracer/paths.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/waypoints.hpp"
#include "wavetracer/world.hpp"

namespace wavetracer {

// Counts of one frame. Every approximation and every loss is visible here.
struct FrameCounts {
  uint64_t rays = 0;      // launched
  uint64_t segments = 0;  // rays traced or answered by the cache, all depths
  uint64_t hits = 0;
  uint64_t sequences = 0;   // distinct prefixes, the empty one excluded
  uint64_t candidates = 0;  // sequence and receiver pairs that pass the conservative rejection
  uint64_t solved = 0;      // candidates whose points lie in their surfaces
  uint64_t paths = 0;       // visible, distinct
  uint64_t receptions = 0;  // segments that passed a receiver, with trace.reception = "sphere"
};

// What the ray cache did in a frame. Counts are of this frame alone.
struct CacheSummary {
  bool on = false;          // false: the frame had no cache, and everything below is 0 or empty
  uint64_t lookups = 0;     // rays that asked, all depths
  uint64_t hits = 0;        // of these, answered; the others were traced
  uint64_t conflicts = 0;   // misses because of another look-up or a write of that moment
  uint64_t stale = 0;       // misses although the key was there: purging did not let its entry stand
  uint64_t stored = 0;      // entries written
  uint64_t replaced = 0;    // of these, over another one
  uint64_t duplicates = 0;  // writes of a key that was there already
  uint64_t dropped = 0;     // writes that met another one or found no place; their segments are traced again
  uint64_t exhausted = 0;   // of these, for want of a free entry
  uint64_t evicted = 0;     // entries removed: unused for long, or of a transmitter that has moved on
  uint64_t linked = 0;      // with cache.statistics: hits on the entry that the ray's last one links to
  // The table as the frame leaves it: entries it has room for, those that hold a segment, device memory.
  uint64_t entries = 0, used = 0, bytes = 0;
  std::vector<uint64_t> lookups_per_depth, hits_per_depth;  // [0]: segments from transmitters
  // With cache.statistics: how many of the used entries have answered 0, 1, 2, 3-4, 5-8, 9-16, ... times. Else empty.
  std::vector<uint64_t> entries_by_hits;
};

// Seconds a stage: device stages from profiling events, host stages from a steady clock.
using StageSeconds = std::map<std::string, double>;

// Links without a path: why, of the first few, in words, and how many there are. Receivers of grids are counted apart,
// because those that are inside of houses have none.
struct MissingLinks {
  static constexpr size_t shown = 5;
  uint64_t links = 0, in_grids = 0;
  std::vector<std::string> why, why_in_grids;
  bool empty() const { return links + in_grids == 0; }
};

struct FrameResult {
  uint32_t frame = 0;
  WorldState world;
  Paths paths;
  FrameCounts counts;
  MissedCounts missed;  // frames = 0 with a ray cache or trace.reception = "sphere", and where no rays were launched
  StageSeconds seconds;
  std::vector<uint64_t> segments_per_depth;
  CacheSummary cache;
  WaypointRows waypoints;  // of output.waypoints samples a transmitter
  std::vector<std::string> warnings;
  MissingLinks missing;  // by Simulation::explain_missing, where somebody asked
};

struct DeviceSummary {
  std::string platform, name, driver, opencl_c;
  bool gpu = false;
};

// How rays were ordered and launched.
struct OrderSummary {
  std::string method = "none";  // plain name; "none" too where order.method = "auto" found no sort that pays
  bool each_depth = false;
  std::string launch_shape = "1d";
  uint32_t local_size = 0;  // 0: what suits the device
  std::string reason;       // why, where order.method = "auto"
};

// A part of the model that the configuration asks for or not, and that the scene needs or not.
struct Feature {
  bool on = false;
  std::string reason;  // why not: "trace.diffraction = false", "no edge of the scene diffracts", ...
};
// By name: reflection, diffraction, double_diffraction, transmission, scattering, instances. What is off runs no
// kernel.
using Features = std::map<std::string, Feature>;

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
