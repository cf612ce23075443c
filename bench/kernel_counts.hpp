// SPDX-License-Identifier: Apache-2.0
// Numbers of items, bytes and operations of kernels in a frame, for the table of kernel_costs.cpp. They are lower
// bounds: a search in a tree of n triangles visits a node of eight boxes per level and one triangle; a reflection costs
// its image and its point. If a count is unknown, the smallest possible one is used.
#pragma once
#include <algorithm>
#include <cmath>

#include "kernel_costs.hpp"
#include "wavetracer/device/beams.h"
#include "wavetracer/device/cache.h"
#include "wavetracer/device/field_records.h"
#include "wavetracer/device/points.h"
#include "wavetracer/device/waypoints.h"

namespace wavetracer::bench::counts {

using namespace device;
using N = const FrameNumbers&;

inline constexpr double word = sizeof(uint32_t), ray_m = 6 * word, hit = WT_HIT_PLANES * word, node = sizeof(uint64_t);
inline constexpr double box_operations = 12, triangle_operations = 40;  // slab tests; edge tests and a division
inline constexpr double image_operations = 11, point_operations = 30;   // for a reflection, in double
inline constexpr double wedge_operations = 60;                          // for the shortest way over an edge
inline constexpr double sphere_operations = 20, reach_operations = 45;  // for a segment and a receiver
inline constexpr double labelled = WT_RAY_LABELLED_PLANES * word, queued = WT_RAY_PLANES * word;

inline double nothing(N) { return 0; }
template <size_t bytes>
inline double always(N) {
  return static_cast<double>(bytes);
}
inline double segments(N n) { return static_cast<double>(n.frame.counts.segments); }
inline double rays(N n) { return static_cast<double>(n.frame.counts.rays); }
// Segments after the first.
inline double later_segments(N n) { return segments(n) - rays(n); }
inline double nodes(N n) { return static_cast<double>(n.frame.counts.sequences) + n.transmitters(); }
template <size_t size>
struct Name {
  char text[size];
  constexpr Name(const char (&name)[size]) { std::copy_n(name, size, text); }
};
template <Name kernel>
inline double items_of(N n) {
  return n.items(kernel.text);
}

// Slots of the table of sequences, several for a work-item.
template <Name kernel>
inline double slots_of(N n) {
  return n.items(kernel.text) * n.tuning.slots.per_item;
}
// Tiles that ends try by a chain of mirrors, of which a work-item takes several.
template <Name kernel>
inline double tries_of(N n) {
  return n.items(kernel.text) * n.tuning.points.per_item;
}
inline double onlooking_nodes(N n) { return n.items("point_prefixes/onlookers") / n.tuning.onlooker_lanes; }
// Prefixes with all points of targets, which the work-items of a prefix share.
inline double points_of_prefixes(N n) {
  return n.items("target_edges/target_edges") / n.tuning.join_lanes * static_cast<double>(n.frame.world.targets.size());
}
// Chains of facets of bodies with all links, from both ends, of which a work-item takes several.
inline double bounced_chains(N n) { return n.items("target_bounces/target_bounces") * n.tuning.points.per_item; }
inline double edges_of_tiles(N n) { return n.items("tile_edges/tile_edges") / n.tuning.join_lanes; }
inline double blocks_of_rays(N n) { return std::ceil(segments(n) / n.tuning.block); }
// The sequences that rays have met, where a work-item or several take one.
template <Name kernel>
inline double met_by(N n) {
  return std::min(n.items(kernel.text), nodes(n));
}

inline double scene_operations(N n) { return tree_operations(n.triangles); }
inline double trace_bytes(N) { return ray_m + hit; }
inline double vehicles_operations(N n) { return instance_tree_operations(n.frame.world.instances.size()); }
// A ray is read once, and each of its hits is added to a sequence.
inline double bounces_bytes(N n) {
  return (rays(n) * (ray_m + 2 * word) + n.hit_share() * segments(n) * (node + word)) / segments(n);
}
inline double interact_bytes(N n) { return word + n.hit_share() * (word + ray_m + 2 * word + queued + node); }
inline double missed_rays(N n) { return n.cache_misses() * static_cast<double>(n.frame.cache.lookups); }
inline double links_of_sums(N n) { return static_cast<double>(n.frame.world.links.size()); }
inline double lookups(N n) { return static_cast<double>(n.frame.cache.lookups); }
inline double traced(N n) { return static_cast<double>(n.frame.cache.traced); }
inline double entries(N n) { return static_cast<double>(n.frame.cache.entries); }
inline double lookup_bytes(N n) { return labelled + sizeof(wt_cache_entry) * (1 - n.cache_misses()) + hit + word; }
inline double pairs(N n) { return n.items("receive/receive") * n.receivers(); }
inline double first_pairs(N n) { return n.items("receive/first_receiver") * n.receivers(); }
inline double segment_bytes_per_pair(N n) { return (ray_m + 3 * word) / n.receivers(); }

inline double mirror_operations(N n) { return n.depth() * (image_operations + point_operations); }
inline double solved_bytes(N n) { return sizeof(wt_solved) + n.depth() * (3 * sizeof(double) + word); }
inline double solve_bytes(N n) {
  const double kept = n.items("visible/visible") / n.items("solve/solve");
  return sizeof(wt_candidate) + kept * solved_bytes(n);
}
inline double visible_bytes(N n) {
  const double kept = static_cast<double>(n.frame.counts.paths) / n.items("visible/visible");
  return 2 * word + 2 * std::min(kept, 1.0) * solved_bytes(n);
}
inline double legs(N n) { return n.items("visible/visible") * (n.depth() + 1); }
inline double leg_bytes(N) { return 2 * 3 * sizeof(double); }
inline double candidate_pairs(N n) { return nodes(n) * n.receivers(); }
inline double joined(N n) { return n.beside_mirrors(); }
inline double join_bytes(N) { return sizeof(wt_wedge_candidate); }
inline double wedge_solve_bytes(N) { return sizeof(wt_wedge_candidate) + sizeof(wt_wedge); }
inline double wedge_solve_operations(N n) { return wedge_operations + std::max(n.depth() - 1, 0.0) * image_operations; }
inline double point_of_rows(N n) { return (n.depth() + 1) * 9; }
inline double path_rows(N n) { return static_cast<double>(n.frame.counts.paths); }
inline double row_bytes(N n) { return solved_bytes(n) + sizeof(wt_path_row) + n.depth() * sizeof(wt_vertex_row); }
inline double field_operations(N n) { return 400 + n.depth() * 700; }  // two antennas; a slab and its change of basis
// It reads the root of the tree for every leg, and no volume.
inline double vegetation_bytes(N n) { return solved_bytes(n) + sizeof(double); }
inline double vegetation_operations(N n) { return (n.depth() + 1) * 2 * box_operations; }
inline double scatter_bytes(N) { return sizeof(wt_solved) + 2 * 3 * sizeof(double) + word; }

inline double apertures(N n) { return n.items("beam_gather/beam_gather") / n.tuning.gather_lanes; }
inline double candidates_of_beams(N n) {
  return n.items("beam_visible/beam_visible") / n.tuning.visible_lanes * n.tuning.visible_targets;
}
// Those without a piece count too, since a round has as many groups as any other.
inline double waiting_groups(N n) { return n.items("beam_visible/beam_waiting") / n.tuning.visible_lanes; }
inline double united_apertures(N n) { return n.items("beam_unite/beam_unite") / n.tuning.visible_lanes; }

}  // namespace wavetracer::bench::counts
