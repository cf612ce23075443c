// SPDX-License-Identifier: Apache-2.0
// Decides which frames launch rays: all of them, or those that trace.discover_every_s chooses.
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

  // Does the frame of this world launch rays? It does if it is cold, if every_s have passed since the last frame that
  // did, in either direction of time, or if a vehicle is present or a transmitter sends that did not in that frame, or
  // has come since. If it does, `last` becomes this frame.
  bool due(const WorldState& world, bool cold, DiscoveryMark& last) const;
  bool spares() const { return every_s_ > 0; }

 private:
  // A flag for each vehicle that is present, then for each transmitter that sends.
  static std::vector<bool> active(const WorldState& world);

  double every_s_;
};

// The warning about shards that are no longer than discover_every_s: they begin cold, so nothing is measured in them.
std::optional<std::string> unmeasured_warning(double discover_every_s, double step_s, uint64_t frames,
                                              uint64_t shard_frames);

}  // namespace wavetracer
