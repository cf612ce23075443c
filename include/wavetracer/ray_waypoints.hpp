// SPDX-License-Identifier: Apache-2.0
// Waypoints of samples of launched rays, for study and pictures: the points of each ray, even if it led to no path.
// Columns have equal length and are sorted by frame, tx, sample, depth; hits come before the end of their segment, by
// receiver.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace wavetracer {

enum class WaypointKind : uint8_t {
  launch = 0,
  reflection = 1,
  diffraction = 2,
  hit = 3,   // a receiver's centre, which the segment passes within trace.sphere_radius_m
  miss = 4,  // a point 1 m along the segment that met nothing
};

// The origin of the hit at the end of the segment before a waypoint.
enum class WaypointSource : uint8_t {
  launch = 0,   // there is no segment before it
  traced = 1,   // the ray was traced
  cache = 2,    // the ray cache answered: an entry of its table, or the ray that was traced for a group
  unknown = 3,  // the segment after the last interaction of a ray, whose end is not kept
};

struct WaypointRows {
  std::vector<uint32_t> frame, tx;
  std::vector<uint64_t> sample;  // launch index of the ray, counted for its transmitter
  std::vector<uint32_t> depth;   // number of segments before this point: 0 at the transmitter
  std::vector<WaypointKind> kind;
  std::vector<glm::dvec3> position_m;  // file coordinates
  std::vector<uint32_t> surface;       // as in Paths; for a hit the receiver; no_surface for launches and misses
  std::vector<uint32_t> instance;      // the vehicle of a moving surface, else no_instance
  std::vector<WaypointSource> source;

  size_t size() const { return tx.size(); }
};

constexpr uint32_t no_surface = 0xFFFFFFFFu;

}  // namespace wavetracer
