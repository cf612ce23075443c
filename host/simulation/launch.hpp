// SPDX-License-Identifier: Apache-2.0
// A launch: the ends that send rays, their directions, and the counts of its discovery. Launches are values: they say
// what is traced, not how.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "passes/generate_rays.hpp"

namespace wavetracer {

// Every stride-th direction of the full set, from `phase` on. Neighbours in a sorted launch are stride apart.
struct DirectionShare {
  uint64_t phase = 0, stride = 1;
};

struct Launch {
  std::vector<Launcher> who = {};
  uint64_t rays = 1;  // directions of the full set, the same number for each launcher
  DirectionShare share = {};
  bool followed = true;  // recorded by RayFollower
  bool sorted = true;    // by order.method, if the launch has all trace.rays directions

  uint64_t rays_each() const { return (rays - share.phase + share.stride - 1) / share.stride; }
  uint64_t total() const { return rays_each() * who.size(); }
};

// Launchers that are not on a vehicle; positions in recentred metres.
inline std::vector<Launcher> launchers(const std::vector<glm::dvec3>& transmitters) {
  std::vector<Launcher> out;
  for (const glm::dvec3& position : transmitters) out.push_back({static_cast<uint32_t>(out.size()), position});
  return out;
}

// The reason why a refined launch ended: it reached trace.recall; its next level would launch more than trace.max_rays;
// its cells are as small as possible; or none of its last rays met anything rare, so that nothing is left to refine.
enum class LaunchEnd { recall, max_rays, finest, nothing_rare };

// The counts of a discovery by beams.
struct BeamCounts {
  uint32_t depth = 0;      // reflections and diffractions
  uint32_t edges = 0;      // the most edges of a path; all edges that ends see in their mirrors were found
  uint64_t ends = 0;       // ends that were looked from
  bool any_depth = false;  // no beam was left to follow at the last depth
  // Bounds of solid angles, added up over all ends: of beams that were too thin to follow; of these, each times the
  // share of its power that mirrors have left; and the latter of beams whose paths are too weak.
  double left_out_sr = 0, thin_sr = 0, weak_sr = 0;
  std::optional<double> floor_db = {};  // the gain below which a path is too weak
};

// The counts that discovery adds to FrameCounts.
struct DiscoveryCounts {
  uint64_t rays = 0, hits = 0;
  std::vector<uint64_t> segments_per_depth;
  uint64_t unread = 0;  // rays with segments that the device counted, not read yet (wt_counters::ended)
  // For a refined launch: the share of sequences that a single sample met, and why the launch ended.
  double share_once = 0;
  LaunchEnd end = LaunchEnd::recall;
  // The largest area that rays share at the other end of a link (launch_spacing.hpp), and the rays of each transmitter.
  double spread_m2 = 0, rays_each = 0;
  std::optional<BeamCounts> beams = {};  // set by a discovery by beams, which launches no rays

  // Adds the segments of `alive` rays. ended: the number of them that ended after each number of hits.
  void add_ended(uint64_t alive, const wt_uint* ended) {
    for (uint64_t& segments : segments_per_depth) {
      segments += alive;
      alive -= *ended++;
      hits += alive;
    }
  }
  // Adds another launch that was not refined.
  void add(const DiscoveryCounts& more) {
    rays += more.rays;
    hits += more.hits;
    unread += more.unread;
    if (rays_each == 0) rays_each = more.rays_each;  // transmitters come first
    if (segments_per_depth.size() < more.segments_per_depth.size())
      segments_per_depth.resize(more.segments_per_depth.size());
    for (size_t k = 0; k < more.segments_per_depth.size(); ++k) segments_per_depth[k] += more.segments_per_depth[k];
  }
};

}  // namespace wavetracer
