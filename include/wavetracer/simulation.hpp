// SPDX-License-Identifier: Apache-2.0
// The public entry of libwavetracer: a scene on a device, computed frame by frame.
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
#include "wavetracer/gradient.hpp"
#include "wavetracer/scene.hpp"

namespace wavetracer {

// Progress of a frame: `done` of `total`, in the unit of the stage.
struct FrameProgress {
  Choice<"rays", "paths"> stage;  // rays that were launched, then steps of the exact solution
  uint64_t done = 0, total = 0;
  uint64_t part = 0, parts = 1;  // parts of the frame, counted from 0: batches of receivers (trace.batch_receivers)
};
// Called between batches of rays and between these steps; if it returns false, the frame is cancelled.
using FrameObserver = std::function<bool(const FrameProgress&)>;

// Called with the number of frames of a world that was loaded.
using FramesPlanned = std::function<void(uint64_t frame_count)>;

// Thrown by run_frame() if the observer has cancelled the frame. The simulation can continue with any frame.
class FrameStopped : public std::runtime_error {
 public:
  FrameStopped() : std::runtime_error("the frame was given up") {}
};

// Transmitters first to end - 1.
struct TransmitterRange {
  uint32_t first = 0, end = 0;
};

// Returns why frames of this configuration cannot be divided into blocks of transmitters; empty if they can.
std::string block_obstacle(const Config& config);

// Only for a live world, see wavetracer/live.hpp.
struct LiveBounds;
struct LiveFrame;
struct LivePose;
struct LiveTraffic;
struct LiveType;

// The value that runs give to Simulation::profile_every.
inline constexpr uint32_t profiled_frames = 16;

class Simulation {
 public:
  // Loads the scene, builds surfaces and acceleration structures, compiles the kernels.
  // device: text that matches a platform or device name, an index, or empty for the default choice. planned: called
  // with the number of frames when the world is known and before kernels are compiled; it may throw.
  // Throws ConfigError, InputError or DeviceError.
  Simulation(const Config& config, const std::string& device = "", const FramesPlanned& planned = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  // Frames of one drive may be computed in any order; with trace.reuse, the result of a frame depends on the frames
  // since the last forget(). Throws ConfigError for a frame that the world does not have.
  FrameResult run_frame(uint32_t frame);
  // Computes only the links of these transmitters, exactly as run_frame() finds them: results of earlier frames are not
  // reused. Counts are of the work that was done, which includes the rays of other ends. Throws ConfigError if the
  // configuration couples all transmitters, see block_obstacle().
  FrameResult run_block(uint32_t frame, TransmitterRange transmitters);
  // Computes the drive at any time from its first frame to its last, for all links, or for these of them alone. The
  // frame has the number 0. Throws ConfigError for another time, and unless trace.discovery = "beams", because such
  // instants leave nothing for each other.
  FrameResult run_time(double time_s, const std::vector<Link>* only = nullptr);
  // Returns a bound of how far any end and any point of a vehicle is from its place at from_s, at all times from then
  // to to_s, which may be before; infinity if a vehicle comes or goes in between. Throws ConfigError for a [[mount]]
  // whose height follows the ground.
  double motion_m(double from_s, double to_s) const;
  // Computes a frame of poses that come at run time, in a world with [[live_vehicle]]. Updates the traffic. Throws
  // PoseError, which changes nothing, and ConfigError if there is no [[live_vehicle]].
  LiveFrame run_poses(LiveTraffic& traffic, double time_s, std::span<const LivePose> poses);
  // Computes a frame at a time between the last two frames of poses of that traffic, which it does not change: vehicles
  // follow the cubic that has the positions and velocities of both, and turn evenly. With trace.discover_every_s such
  // frames launch no rays. Throws PoseError for any other time.
  LiveFrame run_between(const LiveTraffic& traffic, double time_s);
  // Takes a result that is needed no more: the next frame uses the memory of its paths or sums, which saves time where
  // a frame has many. The result is left without paths and sums.
  void give_back(FrameResult& result);
  const std::vector<LiveType>& live_types() const;
  const LiveBounds& live_bounds() const;
  // Measures the device's stages in every `frames`-th frame only: profiling makes launches slower, which short frames
  // notice (on a GPU by a third). With 1, the default, every frame is measured. Blocks (run_block) are always measured.
  void profile_every(uint32_t frames);
  // After sum_links(true), frames have FrameResult::summed in place of paths: the device sums the paths of each link,
  // and the host does not read them. That is for many links, as in maps. There are no elements of arrays then, and no
  // fields at other carriers.
  void sum_links(bool on);
  // Sets the observer of all following frames; an empty function removes it.
  void observe(FrameObserver observer);
  // Drops all sequences of earlier frames, and the content of a ray cache: the next frame is cold.
  void forget();
  uint64_t frame_count() const;
  double time_s(uint32_t frame) const;
  const Scene& scene() const;
  // Returns the configuration; its transmitters and receivers include the ends that are mounted on vehicles.
  const Config& config() const;
  const std::vector<Instance>& instances() const;
  // The targets that Paths::target names.
  std::vector<SensedTarget> targets() const;
  const std::vector<Scene>& models() const;
  // Explains why links of a frame have no path: what their direct lines meet first, and which disabled feature may add
  // paths. It costs a pass over the scene.
  MissingLinks explain_missing(const FrameResult& frame) const;
  // Returns warnings: what was left out or assumed when the scene and the trajectories were loaded; antennas and
  // vehicles in impossible places.
  std::vector<std::string> warnings() const;
  // Returns the exact derivatives of the columns of a frame's paths at the first carrier, by materials and by the
  // positions and turns of the ends; the host computes them. The frame is one of this simulation. Throws ConfigError if
  // choice.paths has a row that the frame lacks, or if the frame has sums in place of paths.
  PathGradients gradient(const FrameResult& frame, const GradientChoice& choice = {});
  // Returns what the radars of the configuration receive in a frame of this simulation, with all cubes or with none.
  // Frames of live worlds have none by themselves; other frames have it in FrameResult::radars, with the cubes that
  // radar.cube asks for. Throws ConfigError if the frame has sums in place of paths, RuntimeError if it has too many
  // cells.
  std::vector<RadarRows> radars(const FrameResult& frame, bool with_cubes = true) const;
  // Returns the number of complex values that all cubes of the radars in a frame have. It computes none of them.
  uint64_t radar_cells(const FrameResult& frame) const;
  // The axes of their maps, for each [[radar]].
  std::vector<RadarAxes> radar_axes() const;
  const DeviceSummary& device() const;
  const OrderSummary& order() const;
  const Features& features() const;
  // The number of rays from each edge, as trace.edge_rays asks or "auto" chose; 0 without diffraction.
  uint64_t edge_rays() const;
  // The range of frames whose links are summed, as trace.diffraction_range_db asks or "auto" chose; 0 where none is
  // left out.
  double diffraction_range_db() const;
  // Stages outside the frame: load, surfaces, build, compile, ...
  const StageSeconds& setup_seconds() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer
