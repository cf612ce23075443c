// Tracks of waypoints: positions and times alone, everything else follows from them.
// Assumes scene coordinates; gaps are meant, so no track is cut.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "motion/read.hpp"
#include "motion/track_motion.hpp"
#include "motion/vehicle_types.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

Trajectories connect_waypoints(std::span<const WaypointTrack> tracks) {
  Trajectories out;
  std::set<std::string_view> ids;
  for (const WaypointTrack& from : tracks) {
    const auto fail = [&](size_t k, std::string_view what) {
      throw InputError(fmt::format("waypoint {} of '{}': {}", k, from.id, what));
    };
    check_type(from.type);
    if (from.waypoints.empty()) throw InputError(fmt::format("'{}' has no waypoint; it needs at least one", from.id));
    if (!ids.insert(from.id).second) {
      throw InputError(fmt::format("'{}' is defined twice; ids must be unique", from.id));
    }
    auto type = std::find(out.types.begin(), out.types.end(), from.type);
    if (type == out.types.end()) type = out.types.insert(type, from.type);
    Track track{from.id, static_cast<uint32_t>(type - out.types.begin()), {}, {0}};
    for (size_t k = 0; k < from.waypoints.size(); ++k) {
      const auto& [time_s, p] = from.waypoints[k];
      for (const double value : {time_s, p.x, p.y, p.z}) {
        if (!std::isfinite(value)) fail(k, fmt::format("{} is not a finite number", value));
      }
      if (k > 0 && time_s <= from.waypoints[k - 1].time_s) {
        fail(k, fmt::format("time must increase, but {} s follows {} s", time_s, from.waypoints[k - 1].time_s));
      }
      Sample sample;
      sample.time_s = time_s;
      sample.position_m = p;
      track.samples.push_back(sample);
    }
    complete_headings(track);
    complete_velocities(track);
    out.tracks.push_back(std::move(track));
  }
  if (out.tracks.empty()) return out;
  set_order(out);
  return out;
}

}  // namespace wavetracer
