// What moves: vehicle models, instances, radio ends and links of every frame, from configuration and trajectories.
// A world without trajectories has one frame, at 0 s. A live world ([[live_vehicle]]) has that frame, with nobody
// there, and those of poses that come at run time.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "motion/trajectories.hpp"
#include "wavetracer/config.hpp"
#include "wavetracer/live.hpp"
#include "wavetracer/scene.hpp"
#include "wavetracer/world_state.hpp"

namespace wavetracer {

class World {
 public:
  // scene: the static one; only its origin, extent and numbers of surfaces and wedges are used. Throws ConfigError or
  // InputError.
  World(const Config& config, const Scene& scene);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  // Vehicle models: recentred like any Scene; Placement takes their origin into account.
  const std::vector<Scene>& models() const;
  const std::vector<Instance>& instances() const;
  // All radio ends of all frames: those of the configuration, then those mounted on vehicles, by track, then by mount.
  const std::vector<RadioEnd>& transmitters() const;
  const std::vector<RadioEnd>& receivers() const;

  // Of each transmitter the receiver that is the same end (it stands in the same place, or in the same place on the
  // same vehicle), no_end where there is none; and the other way round.
  const std::vector<uint32_t>& receiver_of_transmitter() const;
  const std::vector<uint32_t>& transmitter_of_receiver() const;

  // Recentred; of a live world a track per place.
  const Trajectories& trajectories() const;
  // Whether [links] allows any pair of ends at all, wherever they are.
  bool any_link_allowed() const;

  uint64_t frame_count() const;
  double time_s(uint64_t frame) const;
  double step_s() const;  // between frames
  // Vehicles that are absent, and their antennas, are where they were last or will be first. Throws ConfigError for a
  // frame that there is not.
  WorldState state(uint64_t frame) const;

  bool live() const;
  const std::vector<LiveType>& live_types() const;
  const LiveBounds& live_bounds() const;
  // Of a live world: the vehicles of the traffic after these poses. Throws PoseError, and leaves the traffic as it was;
  // ConfigError where the world is not live.
  WorldState live_state(LiveTraffic& traffic, double time_s, std::span<const LivePose> poses) const;
  // What ends and instances are called in a frame of this traffic.
  void set_names(const LiveTraffic& traffic, LiveFrame& frame) const;
  // The world at a time between the last two frames of a traffic, with the names of those who are there; see
  // LivePlaces::between.
  WorldState live_state_between(const LiveTraffic& traffic, double time_s, LiveFrame& names) const;

  // No recentred coordinate of an end or of a corner of an instance is larger than this, in any frame.
  double reach_m() const;
  const std::vector<std::string>& warnings() const;

 private:
  const class LivePlaces& places() const;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wavetracer
