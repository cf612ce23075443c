// SPDX-License-Identifier: Apache-2.0
// The costs of kernels, a row each.
#include "kernel_costs.hpp"

#include <algorithm>
#include <cmath>

#include "kernel_counts.hpp"

namespace wavetracer::bench {
namespace {

using namespace counts;

constexpr KernelCost costs[] = {
    {"generate_rays/generate_rays", "reflections", "rays", rays, always<32>, always<20>},
    {"generate_rays/generate_launchers", "diffraction", "rays", rays, always<32>, always<20>},
    {"trace_bvh2/trace", "reflections", "segments", segments, trace_bytes, scene_operations},
    {"trace_bvh8/trace", "reflections", "segments", segments, trace_bytes, scene_operations},
    {"trace_packet16/trace", "reflections", "segments", segments, trace_bytes, scene_operations},
    {"trace_rays/nearest_hits", "", "rays", items_of<"trace_rays/nearest_hits">, always<48>, scene_operations},
    {"trace_rays/any_hits", "", "rays", items_of<"trace_rays/any_hits">, always<36>, always<12>},
    {"bounces/bounces", "reflections", "segments", segments, bounces_bytes, scene_operations},
    {"scan/scan", "reflections", "blocks", blocks_of_rays, always<8>, always<1>},
    {"scan/scan_sums", "reflections", "blocks", blocks_of_rays, always<4>, always<1>},
    {"interact/interact", "reflections", "segments", segments, interact_bytes, always<20>},
    {"sequences/clear", "reflections", "slots", slots_of<"sequences/clear">, always<12>, nothing},
    {"sequences/collect", "reflections", "slots", slots_of<"sequences/collect">, always<8>, nothing},
    {"sequences/commute", "reflections", "sequences", met_by<"sequences/commute">, always<12>, nothing},
    {"sequences/regrow", "", "slots", items_of<"sequences/regrow">, always<8>, nothing},
    {"sequences/follow", "", "sequences", items_of<"sequences/follow">, always<8>, nothing},
    {"candidates/candidates", "reflections", "pairs of a sequence and a receiver", candidate_pairs, nothing,
     always<static_cast<size_t>(reach_operations)>},
    {"solve/solve", "reflections", "candidates", items_of<"solve/solve">, solve_bytes, mirror_operations, true},
    {"occlusion/occlusion", "reflections", "legs", legs, leg_bytes, scene_operations},
    {"visible/visible", "reflections", "solved paths", items_of<"visible/visible">, visible_bytes, nothing},
    {"distinct/row_keys", "reflections", "rows", items_of<"distinct/row_keys">, solved_bytes, point_of_rows, true},
    {"distinct/mark_rows", "reflections", "rows", items_of<"distinct/mark_rows">, solved_bytes, nothing},
    {"distinct/order_rows", "reflections", "rows", items_of<"distinct/order_rows">, always<40>, nothing},
    {"fields/fields", "reflections", "paths", path_rows, row_bytes, field_operations, true},

    {"beam_gather/beam_gather", "beams", "apertures", apertures, always<sizeof(wt_aperture)>, scene_operations},
    {"beam_moving/beam_moving", "kept beams", "apertures that are kept", items_of<"beam_moving/beam_moving">,
     always<sizeof(wt_outlook)>, always<2 * 6 * 12>},
    {"beam_visible/beam_visible", "beams", "candidates", candidates_of_beams, always<sizeof(wt_beam_candidate)>,
     nothing},
    {"beam_visible/beam_waiting", "beams", "groups, one piece or none each", waiting_groups,
     always<sizeof(wt_waiting_piece)>, nothing},
    {"beam_unite/beam_link", "beams", "apertures", items_of<"beam_unite/beam_link">, always<12>, nothing},
    {"beam_unite/beam_unite", "beams", "apertures", united_apertures, always<2 * sizeof(wt_aperture)>, nothing},

    {"order_keys/launch_keys", "ordered", "rays", rays, always<4>, always<30>},
    {"generate_rays/generate_ordered", "ordered", "rays", rays, always<36>, always<20>},
    {"order_keys/queue_keys", "ordered", "segments", later_segments, always<16>, always<30>},
    {"gather_rays/gather_rays", "ordered", "segments", later_segments, always<68>, nothing},

    {"curves/point_keys", "", "points", items_of<"curves/point_keys">, always<20>, always<30>},
    {"curves/encode", "", "cells", items_of<"curves/encode">, always<20>, always<20>},
    {"curves/decode", "", "codes", items_of<"curves/decode">, always<20>, always<20>},

    {"pack_rays/rays_to_planes", "", "rays", items_of<"pack_rays/rays_to_planes">, always<64>, nothing},
    {"pack_rays/planes_to_rays", "", "rays", items_of<"pack_rays/planes_to_rays">, always<56>, nothing},
    {"pack_rays/hits_to_planes", "", "hits", items_of<"pack_rays/hits_to_planes">, always<28>, nothing},
    {"pack_rays/planes_to_hits", "", "hits", items_of<"pack_rays/planes_to_hits">, always<28>, nothing},

    {"generate_rays/generate_samples", "refined", "rays", rays, always<40>, always<20>},
    {"refine/count_ends", "refined", "rays", items_of<"refine/count_ends">, always<8>, nothing},
    {"refine/mark", "refined", "rays", items_of<"refine/mark">, always<12>, nothing},
    {"refine/split", "refined", "cells", items_of<"refine/split">, always<44>, nothing},
    {"refine/count_met", "refined", "slots", items_of<"refine/count_met">, always<4>, nothing},
    {"compact/count_blocks", "refined", "rays", items_of<"refine/mark">, always<4>, nothing},
    {"compact/compact", "refined", "rays", items_of<"refine/mark">, always<4>, nothing},

    {"vegetation/vegetation", "vegetation", "paths", items_of<"vegetation/vegetation">, vegetation_bytes,
     vegetation_operations},
    {"transmissions/transmissions", "transmission", "legs", legs, leg_bytes, scene_operations},
    {"scatter/lit", "scattering", "sequences", items_of<"scatter/lit">, always<12>, always<20>, true},
    {"scatter/scatter", "scattering", "tiles of links", joined, scatter_bytes, nothing},
    {"point_prefixes/onlookers", "scattering by mirrors", "sequences", onlooking_nodes, always<12>,
     always<static_cast<size_t>(image_operations)>, true},
    {"point_prefixes/point_prefixes", "scattering by mirrors", "tiles of sequences",
     tries_of<"point_prefixes/point_prefixes">, nothing, always<static_cast<size_t>(point_operations)>, true},
    {"point_prefixes/point_keys", "scattering by mirrors", "prefixes", items_of<"point_prefixes/point_keys">,
     always<sizeof(wt_solved) + 3 * sizeof(double) + 2 * sizeof(uint32_t)>, always<7>, true},
    {"point_prefixes/place_points", "scattering by mirrors", "prefixes", items_of<"point_prefixes/place_points">,
     always<sizeof(wt_solved) + sizeof(wt_point_prefix) + 3 * sizeof(double)>, always<9>, true},
    {"point_join/point_join", "scattering by mirrors", "paths", path_rows, solved_bytes, nothing},
    {"point_floors/point_floors", "scattering behind edges", "tiles", items_of<"point_floors/point_floors">, always<72>,
     always<16>},
    {"tile_edges/place_tiles", "scattering behind edges", "tiles", items_of<"tile_edges/place_tiles">,
     always<8 * sizeof(double) + 3 * sizeof(uint32_t)>, always<9>, true},
    {"tile_edges/tile_balls", "scattering behind edges", "balls", items_of<"tile_edges/tile_balls">,
     always<WT_TILE_BALL*(sizeof(uint32_t) + 2 * sizeof(float)) + sizeof(wt_tile_ball)>, nothing},
    {"tile_edges/group_balls", "scattering behind edges", "groups", items_of<"tile_edges/group_balls">, always<24>,
     nothing},
    {"tile_edges/tile_edges", "scattering behind edges", "prefixes of edges", edges_of_tiles, nothing, always<60>},
    {"tile_edges/tile_rows", "scattering behind edges", "ways to tiles", items_of<"tile_edges/tile_rows">,
     always<sizeof(wt_solved) + 6 * sizeof(double) + sizeof(uint32_t)>, nothing, true},
    {"crowns/crowns", "crowns", "cells of links", joined, scatter_bytes, nothing},
    {"grazed_faces/grazed_faces", "diffraction", "sequences", met_by<"grazed_faces/grazed_faces">, always<12>,
     mirror_operations, true},
    {"targets/targets", "targets", "points of links", joined, scatter_bytes, nothing},
    {"targets/target_rows", "targets", "ways to points", items_of<"targets/target_rows">,
     always<sizeof(wt_solved) + 3 * sizeof(double) + 2 * sizeof(uint32_t)>, nothing, true},
    {"target_edges/target_edges", "targets behind edges", "points of prefixes", points_of_prefixes, nothing,
     always<30>},
    {"target_bounces/target_bounces", "bounces", "chains of links", bounced_chains, nothing,
     always<static_cast<size_t>(2 * image_operations + point_operations)>, true},
    {"targets/target_bodies", "bodies", "paths", items_of<"targets/target_bodies">,
     always<sizeof(wt_solved) + sizeof(uint32_t)>, nothing, true},
    {"wedge_prefixes/wedge_prefixes", "diffraction", "sequences", items_of<"wedge_prefixes/wedge_prefixes">, always<12>,
     mirror_operations, true},
    {"wedge_prefixes/place_prefixes", "diffraction", "prefixes", items_of<"wedge_prefixes/place_prefixes">,
     always<2 * sizeof(wt_wedge_prefix)>, nothing, true},
    {"edge_rays/edge_rays", "edge rays", "rays", items_of<"edge_rays/edge_rays">, always<static_cast<size_t>(queued)>,
     always<static_cast<size_t>(wedge_operations)>},
    {"hear/hear", "edge rays", "segments", items_of<"hear/hear">, always<static_cast<size_t>(ray_m + 2 * word)>,
     always<static_cast<size_t>(box_operations)>, true},
    {"wedge_join/wedge_join", "diffraction", "candidates", joined, join_bytes, always<60>},
    {"heard_join/heard_join", "edge rays", "candidates", joined, join_bytes, always<60>},
    {"wedge_sight/count_in_sight", "edge rays", "prefixes", items_of<"wedge_sight/count_in_sight">, always<4>, nothing},
    {"link_floors/link_floors", "sums", "paths without edges", items_of<"link_floors/link_floors">, solved_bytes,
     field_operations, true},
    {"link_floors/most_left_out", "sums", "links", links_of_sums, always<4>, always<1>},
    {"wedge_solve/wedge_solve", "diffraction", "candidates", joined, wedge_solve_bytes, wedge_solve_operations, true},
    {"wedge_sight/wedge_sight", "two diffractions", "prefixes", items_of<"wedge_sight/wedge_sight">,
     always<sizeof(wt_wedge_prefix) + sizeof(wt_wedge)>, scene_operations},
    {"wedge_chains/roof_chains", "", "pairs of ends", items_of<"wedge_chains/roof_chains">, always<sizeof(wt_solved)>,
     always<static_cast<size_t>(wedge_operations)>},
    {"link_sums/link_sums", "sums", "paths", path_rows, always<2 * sizeof(device::wt_path_row)>, always<60>, true},
    {"path_groups/path_groups", "diffraction", "paths", path_rows, always<sizeof(device::wt_path_wave)>,
     always<static_cast<size_t>(wedge_operations)>, true},
    {"wedge_pairs/mark_runs", "two diffractions", "prefixes", items_of<"wedge_pairs/mark_runs">, always<12>, nothing},
    {"wedge_pairs/wedge_pairs", "two diffractions", "candidates", joined, join_bytes, scene_operations},

    {"place/place", "drive", "surfaces", items_of<"place/place">, always<2 * sizeof(wt_exact_surface)>, always<66>,
     true},
    {"wedges/wedges", "drive", "wedges", items_of<"wedges/wedges">, always<2 * sizeof(wt_wedge)>, always<66>, true},
    {"top_level/instance_keys", "drive", "vehicles", items_of<"top_level/instance_keys">, always<200>, always<60>},
    {"top_level/leaves", "drive", "vehicles", items_of<"top_level/leaves">, always<200>, nothing},
    {"top_level/inner_boxes", "drive", "vehicles", items_of<"top_level/leaves">, always<96>, nothing},
    {"top_level/top_nodes", "drive", "nodes", items_of<"top_level/top_nodes">, always<128>, nothing},
    {"trace_moving/trace_moving", "drive", "segments", segments, trace_bytes, vehicles_operations},
    {"sequences/keep", "drive", "solved paths", items_of<"sequences/keep">, always<8>, nothing},

    {"label_rays/label_rays", "cache", "rays", rays, always<16>, nothing},
    {"cache_lookup/cache_lookup", "cache", "look-ups", lookups, lookup_bytes, nothing, false, 1, true},
    {"cache_store/cache_store", "cache", "traced segments", traced, always<sizeof(wt_cache_entry) + 36>, nothing, false,
     1, true},
    {"cache_purge/cache_purge", "cache", "entries", entries, always<8>, nothing},
    {"cache_groups/cache_keys", "groups of a cache", "look-ups", lookups, always<60>, nothing},
    {"cache_groups/cache_elect", "groups of a cache", "misses", missed_rays, always<16>, nothing, false, 1},
    {"cache_groups/cache_follow", "groups of a cache", "misses", missed_rays, always<12>, nothing, false, 1},
    {"cache_groups/cache_share", "groups of a cache", "look-ups", lookups, always<4>, nothing},

    {"receive/receive", "spheres", "pairs of a segment and a receiver", pairs, segment_bytes_per_pair,
     always<static_cast<size_t>(sphere_operations)>},
    {"waypoints/waypoints", "spheres", "segments", items_of<"waypoints/waypoints">,
     always<static_cast<size_t>(ray_m + 3 * word + sizeof(wt_waypoint))>, always<6>},
    {"waypoints/gather_waypoints", "spheres", "waypoints", items_of<"waypoints/gather_waypoints">,
     always<2 * sizeof(wt_waypoint)>, nothing},
    {"receive/first_receiver", "spheres of a cache", "pairs of a segment and a receiver", first_pairs,
     segment_bytes_per_pair, always<static_cast<size_t>(sphere_operations)>},
};

}  // namespace

std::span<const KernelCost> kernel_costs() { return costs; }

double tree_operations(size_t triangles) {
  const double levels = std::ceil(std::log2(std::max<double>(static_cast<double>(triangles), 8)) / 3);
  return 8 * box_operations * levels + triangle_operations;
}

double instance_tree_operations(size_t instances) {
  return 2 * box_operations * std::ceil(std::log2(std::max<double>(static_cast<double>(instances), 2)));
}

double FrameNumbers::items(std::string_view kernel) const {
  const auto found = frame.kernels.find(std::string(kernel));
  return found == frame.kernels.end() ? 0.0 : static_cast<double>(found->second.items);
}

double FrameNumbers::depth() const {
  double sum = 0;
  for (const uint32_t depth : frame.paths.depth) sum += depth;
  return frame.paths.size() == 0 ? 0 : sum / static_cast<double>(frame.paths.size());
}

double FrameNumbers::hit_share() const {
  return static_cast<double>(frame.counts.hits) / std::max<double>(static_cast<double>(frame.counts.segments), 1);
}

double FrameNumbers::cache_misses() const {
  return 1 - static_cast<double>(frame.cache.hits) / std::max<double>(static_cast<double>(frame.cache.lookups), 1);
}

double FrameNumbers::beside_mirrors() const {
  return static_cast<double>(frame.counts.candidates) - items("solve/solve");
}

}  // namespace wavetracer::bench
