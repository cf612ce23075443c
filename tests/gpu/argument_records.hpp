// SPDX-License-Identifier: Apache-2.0
// Records that kernels take by value, with their fields: a part of the list of device_records.hpp.
#pragma once
#include <cstddef>
#include <vector>
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/curves.h"

namespace wavetracer::test {

struct Field {
  const char* name;
  size_t offset;
};
struct Record {
  const char* name;
  size_t bytes;
  std::vector<Field> fields;
};

#define FIELD(record, field) \
  { #field, offsetof(record, field) }

inline const std::vector<Record> argument_records{
    {"wt_curve_box",
     sizeof(device::wt_curve_box),
     {FIELD(device::wt_curve_box, lower), FIELD(device::wt_curve_box, scale), FIELD(device::wt_curve_box, cells),
      FIELD(device::wt_curve_box, last)}},
    {"wt_map_arguments",
     sizeof(wt_map_arguments),
     {FIELD(wt_map_arguments, parameter), FIELD(wt_map_arguments, level), FIELD(wt_map_arguments, faces)}},
    {"wt_launcher_arguments",
     sizeof(wt_launcher_arguments),
     {FIELD(wt_launcher_arguments, origin), FIELD(wt_launcher_arguments, root), FIELD(wt_launcher_arguments, source),
      FIELD(wt_launcher_arguments, heights), FIELD(wt_launcher_arguments, window)}},
    {"wt_launch_arguments",
     sizeof(wt_launch_arguments),
     {FIELD(wt_launch_arguments, first_index), FIELD(wt_launch_arguments, stride), FIELD(wt_launch_arguments, number),
      FIELD(wt_launch_arguments, capacity), FIELD(wt_launch_arguments, first_slot), FIELD(wt_launch_arguments, count)}},
    {"wt_samples_arguments",
     sizeof(wt_samples_arguments),
     {FIELD(wt_samples_arguments, capacity), FIELD(wt_samples_arguments, first), FIELD(wt_samples_arguments, count),
      FIELD(wt_samples_arguments, sample_capacity), FIELD(wt_samples_arguments, cosine),
      FIELD(wt_samples_arguments, sine), FIELD(wt_samples_arguments, turn)}},
    {"wt_bounces_arguments",
     sizeof(wt_bounces_arguments),
     {FIELD(wt_bounces_arguments, triangle_slots), FIELD(wt_bounces_arguments, extent_m),
      FIELD(wt_bounces_arguments, capacity), FIELD(wt_bounces_arguments, ray_count),
      FIELD(wt_bounces_arguments, interactions), FIELD(wt_bounces_arguments, trie_mask),
      FIELD(wt_bounces_arguments, now)}},
    {"wt_interact_arguments",
     sizeof(wt_interact_arguments),
     {FIELD(wt_interact_arguments, capacity), FIELD(wt_interact_arguments, ray_count),
      FIELD(wt_interact_arguments, trie_mask), FIELD(wt_interact_arguments, last), FIELD(wt_interact_arguments, now)}},
    {"wt_receive_arguments",
     sizeof(wt_receive_arguments),
     {FIELD(wt_receive_arguments, capacity), FIELD(wt_receive_arguments, ray_count),
      FIELD(wt_receive_arguments, receiver_capacity), FIELD(wt_receive_arguments, radius_m),
      FIELD(wt_receive_arguments, depth), FIELD(wt_receive_arguments, out_capacity)}},
    {"wt_candidates_arguments",
     sizeof(wt_candidates_arguments),
     {FIELD(wt_candidates_arguments, node_count), FIELD(wt_candidates_arguments, receiver_capacity),
      FIELD(wt_candidates_arguments, transmitter_count), FIELD(wt_candidates_arguments, max_reflections),
      FIELD(wt_candidates_arguments, capacity), FIELD(wt_candidates_arguments, nodes_together),
      FIELD(wt_candidates_arguments, parts)}},
    {"wt_solve_arguments",
     sizeof(wt_solve_arguments),
     {FIELD(wt_solve_arguments, candidate_count), FIELD(wt_solve_arguments, max_depth),
      FIELD(wt_solve_arguments, capacity), FIELD(wt_solve_arguments, triangle_slots),
      FIELD(wt_solve_arguments, blocker_mask), FIELD(wt_solve_arguments, wavelength_m)}},
    {"wt_edge_map_arguments",
     sizeof(wt_edge_map_arguments),
     {FIELD(wt_edge_map_arguments, origin), FIELD(wt_edge_map_arguments, cell_m), FIELD(wt_edge_map_arguments, columns),
      FIELD(wt_edge_map_arguments, rows), FIELD(wt_edge_map_arguments, instance_count),
      FIELD(wt_edge_map_arguments, padding)}},
    {"wt_wedge_chains_arguments",
     sizeof(wt_wedge_chains_arguments),
     {FIELD(wt_wedge_chains_arguments, map), FIELD(wt_wedge_chains_arguments, wavelength_m),
      FIELD(wt_wedge_chains_arguments, transmitter_count), FIELD(wt_wedge_chains_arguments, receiver_capacity),
      FIELD(wt_wedge_chains_arguments, most_edges), FIELD(wt_wedge_chains_arguments, max_depth),
      FIELD(wt_wedge_chains_arguments, capacity), FIELD(wt_wedge_chains_arguments, padding)}},
    {"wt_legs_arguments",
     sizeof(wt_legs_arguments),
     {FIELD(wt_legs_arguments, triangle_slots), FIELD(wt_legs_arguments, extent_m),
      FIELD(wt_legs_arguments, solved_count), FIELD(wt_legs_arguments, solved_counter),
      FIELD(wt_legs_arguments, max_depth), FIELD(wt_legs_arguments, most), FIELD(wt_legs_arguments, deepest),
      FIELD(wt_legs_arguments, blocker_mask), FIELD(wt_legs_arguments, tile_count),
      FIELD(wt_legs_arguments, first_leg)}},
    {"wt_lit_arguments",
     sizeof(wt_lit_arguments),
     {FIELD(wt_lit_arguments, node_count), FIELD(wt_lit_arguments, transmitter_count), FIELD(wt_lit_arguments, groups),
      FIELD(wt_lit_arguments, capacity)}},
    {"wt_scatter_arguments",
     sizeof(wt_scatter_arguments),
     {FIELD(wt_scatter_arguments, entry_count), FIELD(wt_scatter_arguments, row_count),
      FIELD(wt_scatter_arguments, rows_per_item), FIELD(wt_scatter_arguments, max_depth)}},
    {"wt_crowns_arguments",
     sizeof(wt_crowns_arguments),
     {FIELD(wt_crowns_arguments, row_count), FIELD(wt_crowns_arguments, rows_per_item),
      FIELD(wt_crowns_arguments, cells), FIELD(wt_crowns_arguments, first_tile),
      FIELD(wt_crowns_arguments, max_depth)}},
    {"wt_wedge_prefixes_arguments",
     sizeof(wt_wedge_prefixes_arguments),
     {FIELD(wt_wedge_prefixes_arguments, trie_mask), FIELD(wt_wedge_prefixes_arguments, node_count),
      FIELD(wt_wedge_prefixes_arguments, capacity), FIELD(wt_wedge_prefixes_arguments, lanes)}},
    {"wt_edge_rays_arguments",
     sizeof(wt_edge_rays_arguments),
     {FIELD(wt_edge_rays_arguments, capacity), FIELD(wt_edge_rays_arguments, first),
      FIELD(wt_edge_rays_arguments, number), FIELD(wt_edge_rays_arguments, count), FIELD(wt_edge_rays_arguments, each),
      FIELD(wt_edge_rays_arguments, pieces), FIELD(wt_edge_rays_arguments, roots), FIELD(wt_edge_rays_arguments, low),
      FIELD(wt_edge_rays_arguments, high)}},
    {"wt_hear_arguments",
     sizeof(wt_hear_arguments),
     {FIELD(wt_hear_arguments, x), FIELD(wt_hear_arguments, y), FIELD(wt_hear_arguments, size),
      FIELD(wt_hear_arguments, low), FIELD(wt_hear_arguments, high), FIELD(wt_hear_arguments, margin),
      FIELD(wt_hear_arguments, columns), FIELD(wt_hear_arguments, rows), FIELD(wt_hear_arguments, capacity),
      FIELD(wt_hear_arguments, ray_count), FIELD(wt_hear_arguments, roots), FIELD(wt_hear_arguments, trie_mask),
      FIELD(wt_hear_arguments, first_listener)}},
    {"wt_sight_arguments",
     sizeof(wt_sight_arguments),
     {FIELD(wt_sight_arguments, count), FIELD(wt_sight_arguments, ends), FIELD(wt_sight_arguments, pieces),
      FIELD(wt_sight_arguments, triangle_slots), FIELD(wt_sight_arguments, extent_m),
      FIELD(wt_sight_arguments, static_surfaces), FIELD(wt_sight_arguments, only_opaque),
      FIELD(wt_sight_arguments, kept_wedges)}},
    {"wt_wedge_join_arguments",
     sizeof(wt_wedge_join_arguments),
     {FIELD(wt_wedge_join_arguments, count), FIELD(wt_wedge_join_arguments, first), FIELD(wt_wedge_join_arguments, end),
      FIELD(wt_wedge_join_arguments, lanes), FIELD(wt_wedge_join_arguments, transmitter_count),
      FIELD(wt_wedge_join_arguments, groups), FIELD(wt_wedge_join_arguments, max_depth),
      FIELD(wt_wedge_join_arguments, capacity), FIELD(wt_wedge_join_arguments, end_detour_m),
      FIELD(wt_wedge_join_arguments, pieces)}},
    {"wt_cache_lookup_arguments",
     sizeof(wt_cache_lookup_arguments),
     {FIELD(wt_cache_lookup_arguments, capacity), FIELD(wt_cache_lookup_arguments, count),
      FIELD(wt_cache_lookup_arguments, now), FIELD(wt_cache_lookup_arguments, touch),
      FIELD(wt_cache_lookup_arguments, static_surfaces), FIELD(wt_cache_lookup_arguments, radius_m),
      FIELD(wt_cache_lookup_arguments, widths)}},
    {"wt_cache_store_arguments",
     sizeof(wt_cache_store_arguments),
     {FIELD(wt_cache_store_arguments, capacity), FIELD(wt_cache_store_arguments, missed_capacity),
      FIELD(wt_cache_store_arguments, missed_count), FIELD(wt_cache_store_arguments, now),
      FIELD(wt_cache_store_arguments, static_surfaces), FIELD(wt_cache_store_arguments, widths)}},
};

#undef FIELD

}  // namespace wavetracer::test
