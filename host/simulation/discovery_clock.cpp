// SPDX-License-Identifier: Apache-2.0
// Times of frames are multiples of a step, so an interval may end a rounding error before a frame. Vehicles and
// transmitters must keep their numbers from frame to frame.
#include "simulation/discovery_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/times.hpp"

namespace wavetracer {

namespace {
// The rounding error of a difference of times near this one.
double interval_tolerance_s(double time_s) { return std::max(1e-9, 2 * time_spacing_s(time_s)); }
}  // namespace

std::vector<bool> DiscoveryClock::active(const WorldState& world) {
  std::vector<bool> out(world.instances.size() + world.transmitters.size());
  for (size_t i = 0; i < world.instances.size(); ++i) out[i] = world.instances[i].present;
  for (const Link& link : world.links) out[world.instances.size() + link.tx] = true;
  return out;
}

bool DiscoveryClock::due(const WorldState& world, bool cold, DiscoveryMark& last) const {
  std::vector<bool> now = active(world);
  bool wanted = cold || !spares() || world.arrivals || !last.time_s ||
                std::abs(world.time_s - *last.time_s) >= every_s_ - interval_tolerance_s(world.time_s);
  for (size_t i = 0; i < now.size() && !wanted; ++i) wanted = now[i] && !(i < last.active.size() && last.active[i]);
  if (wanted) last = {world.time_s, std::move(now)};
  return wanted;
}

std::optional<std::string> unmeasured_warning(double discover_every_s, double step_s, uint64_t frames,
                                              uint64_t shard_frames) {
  const double shard_s = step_s * static_cast<double>(shard_frames);
  if (!(discover_every_s > 0) || frames <= shard_frames || discover_every_s < shard_s - interval_tolerance_s(shard_s))
    return {};
  return fmt::format(
      "the first frame of each output.shard_frames = {} frames ({:.6g} s) launches all rays anew, as often as "
      "trace.discover_every_s = {} asks for rays, and does not measure what the frames before lack: give "
      "output.shard_frames = {} or more",
      shard_frames, shard_s, discover_every_s, static_cast<uint64_t>(std::ceil(10 * discover_every_s / step_s)));
}

}  // namespace wavetracer
