// What kernels take by value: the numbers of one launch of a pass, as one record for each kernel (or for kernels that
// take the same), so that an argument list is its buffers and this record. Capacities are those of the lists written.
#ifndef WAVETRACER_DEVICE_ARGUMENTS_H
#define WAVETRACER_DEVICE_ARGUMENTS_H
#include "wavetracer/device/cache.h"
#include "wavetracer/device/field_records.h"

#ifndef __OPENCL_VERSION__
using wavetracer::device::wt_air;
using wavetracer::device::wt_cache_widths;
#endif

// Of a map from launch indices to directions (directions.h): its step or seed, and the Hilbert curve's level and faces.
typedef struct {
  wt_ulong parameter;
  wt_uint level;
  wt_uint faces;
} wt_map_arguments;

// Who launches: from where, the root of its sequences, what its rays leave (WT_OWN and the instance that carries the
// antenna, or WT_NONE), where its heights begin in their table, and whether that table is a window (directions.h); then
// the origin is the point from which the starts of its rays differ.
typedef struct {
  float origin[3];
  wt_uint root;
  wt_uint source;
  wt_uint heights;
  wt_uint window;
} wt_launcher_arguments;

// Launch indices first_index + stride * k, of which the first has this number in the launch, into slots first_slot + k.
typedef struct {
  wt_ulong first_index;
  wt_ulong stride;
  wt_uint number;
  wt_uint capacity;
  wt_uint first_slot;
  wt_uint count;
} wt_launch_arguments;

// Samples first .. first + count - 1; directions are turned about z by the angle of this cosine and sine, those of
// windows by `turn` in units of 2^-32 turns, within the width of the window.
typedef struct {
  wt_uint capacity;
  wt_uint first;
  wt_uint count;
  wt_uint sample_capacity;
  float cosine;
  float sine;
  wt_uint turn;
} wt_samples_arguments;

typedef struct {
  wt_uint capacity;
  wt_uint ray_count;
  wt_uint trie_mask;
  wt_uint last;  // not 0: nothing is reflected
  wt_uint now;   // of ages
} wt_interact_arguments;

typedef struct {
  wt_uint capacity;
  wt_uint ray_count;
  wt_uint receiver_capacity;
  float radius_m;
  wt_uint depth;
  wt_uint out_capacity;
} wt_receive_arguments;

typedef struct {
  wt_uint node_count;
  wt_uint receiver_capacity;
  wt_uint transmitter_count;
  wt_uint max_reflections;
  wt_uint capacity;
} wt_candidates_arguments;

// Of solve and wedge_solve. Here and below lengths of lists are bounds, where a counter says how long they are.
typedef struct {
  wt_uint candidate_count;
  wt_uint max_depth;
  wt_uint capacity;
  wt_uint triangle_slots;
  wt_uint blocker_mask;
  float wavelength_m;  // the longest; infinite: no wave is too faint (lib/wedge.clh)
} wt_solve_arguments;

typedef struct {
  wt_uint triangle_slots;
  float extent_m;
  wt_uint capacity;
  wt_uint ray_count;
  wt_uint interactions;  // of a ray, at most
  wt_uint trie_mask;
  wt_uint now;  // of ages
} wt_bounces_arguments;

// Of occlusion and transmissions.
typedef struct {
  wt_uint triangle_slots;
  float extent_m;
  wt_uint solved_count;
  wt_uint solved_counter;  // its word of wt_counters, or WT_NONE
  wt_uint max_depth;       // of a row
  wt_uint most;            // transmissions of a path
  wt_uint deepest;         // interactions of a path with transmissions
  wt_uint blocker_mask;    // of the table of what hid paths before
  wt_uint tile_count;      // of surfaces; further tiles are cells of vegetation
  wt_uint first_leg;       // occlusion begins with this leg of each path
} wt_legs_arguments;

typedef struct {
  wt_uint node_count;
  wt_uint transmitter_count;
  wt_uint groups;  // of 16 receivers
  wt_uint capacity;
} wt_lit_arguments;

typedef struct {
  wt_uint entry_count;
  wt_uint row_count;
  wt_uint rows_per_item;
  wt_uint max_depth;
} wt_scatter_arguments;

typedef struct {
  wt_uint row_count;
  wt_uint rows_per_item;
  wt_uint cells;
  wt_uint first_tile;  // the number of the first cell
  wt_uint max_depth;
} wt_crowns_arguments;

typedef struct {
  wt_uint trie_mask;
  wt_uint node_count;
  wt_uint capacity;
} wt_wedge_prefixes_arguments;

// For wedge_join and wedge_pairs: `lanes` work-items take one of the prefixes first to end - 1, in their order, as that
// of the transmitter.
typedef struct {
  wt_uint count;  // of all prefixes
  wt_uint first;
  wt_uint end;
  wt_uint lanes;
  wt_uint transmitter_count;
  wt_uint groups;  // of 16 receivers
  wt_uint max_depth;
  wt_uint capacity;
} wt_wedge_join_arguments;

// Of wedge_sight and wedge_pairs: what stands in the way (lib/sight.clh).
typedef struct {
  wt_uint count;  // of prefixes
  wt_uint triangle_slots;
  float extent_m;
  wt_uint static_surfaces;
  wt_uint only_opaque;  // not 0: waves pass the other surfaces
  wt_uint kept_wedges;  // what is found of pairs of the first so many wedges is kept
} wt_sight_arguments;

// A grid over the edges of the static scene, in plan, and the number of instances, which have edges besides
// (lib/curtain.clh).
typedef struct {
  double origin[2];
  double cell_m;
  wt_uint columns;
  wt_uint rows;
  wt_uint instance_count;
  wt_uint padding;
} wt_edge_map_arguments;

// Strings that are pulled for each pair of a transmitter and a receiver: in planes beside each other, then around what
// they cannot pass over or around one of the roofs, to either side, and farther aside, where there are too many edges.
#define WT_STRINGS_AROUND 9u
#define WT_STRINGS_WIDE 25u
#define WT_STRINGS 57u

typedef struct {
  wt_edge_map_arguments map;
  double wavelength_m;
  wt_uint transmitter_count;
  wt_uint receiver_capacity;
  wt_uint most_edges;
  wt_uint max_depth;
  wt_uint capacity;
  wt_uint padding;
} wt_wedge_chains_arguments;

// Of row_keys, mark_rows and order_rows. twins: not 0 where rows of the other way are counted, each after its own.
typedef struct {
  wt_uint row_count;
  wt_uint visible_counter;  // the word of wt_counters of the visible paths, or WT_NONE
  wt_uint max_depth;
  wt_uint receiver_count;
  wt_uint groups;  // of 16 receivers
  wt_uint twins;
  wt_uint length_bits;  // of a key
} wt_distinct_arguments;

typedef struct {
  double origin[3];  // of recentred coordinates in those of the file
  double wavelength_m;
  wt_ulong seed;
  wt_uint row_count;
  wt_uint row_capacity;
  wt_uint vertex_capacity;
  wt_uint max_depth;
  wt_uint transmissions;
  wt_uint scatters;
  wt_air air;
  wt_uint foliage_count;  // kinds of vegetation
  wt_uint reflections;    // the most of a path
} wt_fields_arguments;

typedef struct {
  double wavelength_m;
  wt_uint row_count;
  wt_uint row_capacity;
  wt_uint max_depth;
  wt_uint padding;
} wt_path_groups_arguments;

typedef struct {
  wt_uint visible_count;
  wt_uint visible_counter;  // its word of wt_counters, or WT_NONE
  wt_uint max_depth;
  wt_uint kinds;  // of vegetation
} wt_vegetation_arguments;

// Of cache_lookup and cache_share. touch: not 0 where the use of an entry is noted.
typedef struct {
  wt_uint capacity;
  wt_uint count;
  wt_uint now;
  wt_uint touch;
  wt_uint static_surfaces;
  float radius_m;
  wt_cache_widths widths;
} wt_cache_lookup_arguments;

typedef struct {
  wt_uint capacity;
  wt_uint missed_capacity;
  wt_uint missed_count;
  wt_uint now;
  wt_uint static_surfaces;
  wt_cache_widths widths;
} wt_cache_store_arguments;

#endif
