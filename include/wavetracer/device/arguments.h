// SPDX-License-Identifier: Apache-2.0
// Arguments that kernels take by value: the numbers of one launch of a pass, as one record for each kernel (or for
// kernels that take the same), so that an argument list is its buffers and this record. A capacity is that of a list
// that is written.
#ifndef WAVETRACER_DEVICE_ARGUMENTS_H
#define WAVETRACER_DEVICE_ARGUMENTS_H
#include "wavetracer/device/cache.h"
#include "wavetracer/device/field_arguments.h"

#ifndef __OPENCL_VERSION__
using wavetracer::device::wt_cache_widths;
#endif

// The constants of a map from launch indices to directions (directions.h): step or seed, and the Hilbert curve's level
// and faces.
typedef struct {
  wt_ulong parameter;
  wt_uint level;
  wt_uint faces;
} wt_map_arguments;

// The transmitter that launches: its place, the root of its sequences, what its rays leave (WT_OWN and the instance
// that carries the antenna, or WT_NONE), where its heights begin in their table, and whether that table is a window
// (directions.h). With a window the origin is the point that the starts of its rays are measured from.
typedef struct {
  float origin[3];
  wt_uint root;
  wt_uint source;
  wt_uint heights;
  wt_uint window;
} wt_launcher_arguments;

// Launch indices first_index + stride * k. The first of them has this number in the launch, and they fill slots
// first_slot + k.
typedef struct {
  wt_ulong first_index;
  wt_ulong stride;
  wt_uint number;
  wt_uint capacity;
  wt_uint first_slot;
  wt_uint count;
} wt_launch_arguments;

// Samples first to first + count - 1. Directions are turned about z by the angle of this cosine and sine; in a window
// they are turned by `turn`, in units of 2^-32 turns, and stay within its width.
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
  wt_uint last;  // not 0: this is the last depth, and nothing is reflected
  wt_uint now;   // the current age
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
  // GPUs: a work-group takes this many sequences with one of the parts of the receivers.
  wt_uint nodes_together;
  wt_uint parts;
} wt_candidates_arguments;

// Numbers for solve and wedge_solve. Here and below a length of a list is a bound where a counter holds the true
// length.
typedef struct {
  wt_uint candidate_count;
  wt_uint max_depth;
  wt_uint capacity;
  wt_uint triangle_slots;
  wt_uint blocker_mask;
  float wavelength_m;      // the longest wavelength; infinite: no wave is too faint (lib/wedge.clh)
  double floors[2];        // wedge_solve: the bounds of paths over one edge and two below which they are left out
  double second;           // wedge_solve: the factor between the floors of a link for two edges and for one
  float left_out_unit;     // wedge_solve: units of left_out that a path at the floor of its link has
  wt_uint receiver_count;  // wedge_solve: links of a transmitter in the tables of links
} wt_solve_arguments;

typedef struct {
  wt_uint triangle_slots;
  float extent_m;
  wt_uint capacity;
  wt_uint ray_count;
  wt_uint interactions;  // the most interactions of a ray
  wt_uint trie_mask;
  wt_uint now;  // the current age
} wt_bounces_arguments;

// Numbers for occlusion and transmissions.
typedef struct {
  wt_uint triangle_slots;
  float extent_m;
  wt_uint solved_count;
  wt_uint solved_counter;  // its word in wt_counters, or WT_NONE
  wt_uint max_depth;       // vertices that a row has room for
  wt_uint most;            // the most transmissions of a path
  wt_uint deepest;         // the most interactions of a path with transmissions
  wt_uint blocker_mask;    // mask of places in the table of what hid paths before
  wt_uint tile_count;      // tiles of surfaces; further tiles are cells of vegetation
  wt_uint first_leg;       // occlusion begins with this leg of each path
  wt_uint open;            // 1: rows end at their last vertex; 0: at their receiver
} wt_legs_arguments;

typedef struct {
  wt_uint node_count;
  wt_uint transmitter_count;
  wt_uint groups;  // groups of 16 receivers
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
  wt_uint lanes;  // work-items of a node
} wt_wedge_prefixes_arguments;

// Numbers for edge_rays: rays from number `number` of prefix `first` on, `each` of every prefix.
typedef struct {
  wt_uint capacity;  // that of the queue
  wt_uint first, number, count, each;
  wt_uint pieces;   // pieces of an edge in the masks of prefixes
  wt_uint roots;    // the roots of the rays' sequences are edges, numbered from here on
  float low, high;  // the heights of the receivers
} wt_edge_rays_arguments;

// Numbers for hear: squares with sides of `size` from (x, y) on, in rows of `columns`.
typedef struct {
  float x, y, size;
  float low, high;  // the heights of all receivers
  float margin;     // the most that a ray passes above or below the receivers of a listener
  wt_uint columns, rows;
  wt_uint capacity, ray_count;  // those of the queue
  wt_uint roots;                // see edge_rays
  wt_uint trie_mask, first_listener;
} wt_hear_arguments;

// Numbers for wedge_join and wedge_pairs: `lanes` work-items take each of the prefixes first to end - 1, in their
// order, as the transmitter's prefix of a pair. heard_join takes the nodes first to end - 1 so, and target_edges takes
// prefixes of all ends, with `count` points.
typedef struct {
  wt_uint count;  // the number of all prefixes
  wt_uint first;
  wt_uint end;
  wt_uint lanes;
  wt_uint transmitter_count;
  wt_uint groups;  // groups of 16 receivers
  wt_uint max_depth;
  wt_uint capacity;
  float end_detour_m;  // the detour over a free end of an edge up to which there are paths
  wt_uint pieces;      // heard_join: pieces of an edge in the masks of prefixes
  float floor;         // wedge_pairs: the bound below which paths are left out
} wt_wedge_join_arguments;

// Things that may block a leg, for wedge_sight and wedge_pairs (lib/sight.clh).
typedef struct {
  wt_uint count;   // the number of prefixes
  wt_uint ends;    // prefixes of the first so many ends are tested
  wt_uint pieces;  // pieces of an edge, at most 32
  wt_uint triangle_slots;
  float extent_m;
  wt_uint static_surfaces;
  wt_uint only_opaque;  // not 0: only opaque surfaces block, waves pass the others
  wt_uint kept_wedges;  // results about pairs of the first so many wedges are kept
} wt_sight_arguments;

// A grid over the edges of the static scene, in plan, and the number of instances, which have edges too
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

// Numbers for row_keys, mark_rows and order_rows. twins: not 0 where each row is followed by that of the link the other
// way.
typedef struct {
  wt_uint row_count;
  wt_uint visible_counter;  // the word in wt_counters that counts visible paths, or WT_NONE
  wt_uint max_depth;
  wt_uint receiver_count;
  wt_uint groups;  // groups of 16 receivers
  wt_uint twins;
  wt_uint length_bits;  // bits of a key that hold the length
} wt_distinct_arguments;

// Numbers for cache_lookup and cache_share. touch: not 0 where the use of an entry is recorded.
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
