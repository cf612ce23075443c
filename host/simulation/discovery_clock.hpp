// When frames launch rays: all of them, or those that trace.discover_every_s says.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "wavetracer/world_state.hpp"

namespace wavetracer {

class DiscoveryClock {
 public:
  // every_s: 0 for all frames.
  explicit DiscoveryClock(double every_s) : every_s_(every_s) {}

  // Whether the frame of this world launches rays. It does if it is cold, if every_s have passed since the last one
  // that did, in either direction of time, or if a vehicle is there or a transmitter sends that did not in that frame,
  // or has come since. If so, it is the last one from now on.
  bool due(const WorldState& world, bool cold, DiscoveryMark& last) const;
  bool spares() const { return every_s_ > 0; }

 private:
  // Of the vehicles, then of the transmitters: whether they are there, and whether they send.
  static std::vector<bool> active(const WorldState& world);

  double every_s_;
};

// What to say of shards that are no longer than discover_every_s: they begin cold, so nothing is measured in them.
std::optional<std::string> unmeasured_warning(double discover_every_s, double step_s, uint64_t frames,
                                              uint64_t shard_frames);

}  // namespace wavetracer
