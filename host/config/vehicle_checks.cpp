// SPDX-License-Identifier: Apache-2.0
// Checks of vehicles that need the whole configuration: their sources, their antennas, the times of the drive.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/contradictions.hpp"

namespace wavetracer::config {
namespace {

void check_times(const std::string& key, const std::vector<std::array<double, 4>>& waypoints, size_t track,
                 std::vector<Contradiction>& out) {
  for (size_t k = 1; k < waypoints.size(); ++k)
    if (!(waypoints[k][0] > waypoints[k - 1][0]))
      out.push_back({{fmt::format("track.{}.{}", track, key)},
                     fmt::format("track.{}[{}] is at {} s, but the waypoint before it is at {} s: times must increase",
                                 key, k, waypoints[k][0], waypoints[k - 1][0])});
}

}  // namespace

void check_trajectories(const Config& config, std::vector<Contradiction>& out) {
  const TrajectoriesConfig& t = config.trajectories;
  if (!t.file.empty() && !t.generate.empty())
    out.push_back({{"trajectories.generate", "trajectories.file"},
                   "trajectories.file and trajectories.generate exclude each other: remove one of them"});
  const bool carried = std::ranges::any_of(config.parked, &ParkedConfig::mounts);
  if (t.file.empty() && t.generate.empty() && config.tracks.empty() && config.live_vehicles.empty() && !carried &&
      !config.mounts.empty())
    out.push_back({{"mount.0"},
                   "[[mount]] needs vehicles: give trajectories.file, trajectories.generate, a [[track]] or, "
                   "for `wavetracer serve`, a [[live_vehicle]]"});
  for (size_t i = 0; i < config.tracks.size(); ++i) {
    check_times("waypoints", config.tracks[i].waypoints, i, out);
    check_times("waypoints_wgs84", config.tracks[i].waypoints_wgs84, i, out);
  }
  for (size_t i = 0; i < config.mounts.size(); ++i)
    if (!config.mounts[i].node.empty() && from_ground(config.mounts[i].above))
      out.push_back({{fmt::format("mount.{}.node", i), fmt::format("mount.{}.above", i)},
                     fmt::format("[[mount]] \"{}\": node says how high the antenna is, "
                                 "so above = \"ground\" cannot say it, too: leave one of them out",
                                 config.mounts[i].name)});
  for (size_t i = 0; i < config.parked.size(); ++i)
    if (config.parked[i].places.empty() == config.parked[i].file.empty())
      out.push_back({{fmt::format("parked.{}.places", i), fmt::format("parked.{}.file", i)},
                     fmt::format("[[parked]] \"{}\" needs places or a file, {}", config.parked[i].name,
                                 config.parked[i].places.empty() ? "and has neither" : "and not both")});
  const TimeConfig& time = config.time;
  if (time.start_s && time.end_s && *time.end_s < *time.start_s)
    out.push_back({{"time.start_s", "time.end_s"},
                   fmt::format("time.end_s = {} is before time.start_s = {}: give an end that is later than the start",
                               *time.end_s, *time.start_s)});
}

}  // namespace wavetracer::config
