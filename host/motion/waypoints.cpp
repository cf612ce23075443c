// SPDX-License-Identifier: Apache-2.0
// Makes tracks of waypoints: only positions and times are given, everything else follows from them.
// Positions are in scene coordinates; gaps are intended, so no track is cut.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string_view>

#include "motion/pose.hpp"
#include "motion/read.hpp"
#include "motion/track_motion.hpp"
#include "motion/vehicle_types.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

namespace {

// Puts a track onto the ground: adds samples, 2 m apart along the way, each at the height of the ground there.
void lay_on_ground(Track& track, const GroundHeight& ground) {
  constexpr double step_m = 2, most_pieces = 100000;
  std::vector<Sample> samples;
  double ground_m = 0;
  const auto add = [&](double time_s) {
    Sample s;
    s.time_s = time_s;
    s.position_m = pose_at(track, time_s)->position_m;
    ground_m = ground(glm::dvec2(s.position_m)).value_or(ground_m);
    s.position_m.z += ground_m;
    samples.push_back(s);
  };
  for (size_t k = 0; k < track.samples.size(); ++k) {
    const Sample& here = track.samples[k];
    add(here.time_s);
    if (k + 1 == track.samples.size()) break;
    const Sample& next = track.samples[k + 1];
    const double way_m = glm::distance(here.position_m, next.position_m);
    const double pieces = std::clamp(std::ceil(way_m / step_m), 1.0, most_pieces);
    for (double i = 1; i < pieces; ++i) add(here.time_s + (next.time_s - here.time_s) * i / pieces);
  }
  track.samples = std::move(samples);
  complete_headings(track);
  complete_velocities(track);
}

}  // namespace

Trajectories connect_waypoints(std::span<const WaypointTrack> tracks, const GroundHeight& ground) {
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
  for (const WaypointTrack& from : tracks)
    if (from.above_ground && ground)
      // The step remains that of the waypoints.
      lay_on_ground(*std::ranges::find(out.tracks, from.id, &Track::id), ground);
  return out;
}

}  // namespace wavetracer
