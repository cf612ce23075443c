// SPDX-License-Identifier: Apache-2.0
// Records of paths over points that are joined from prefixes of both ends (kernels/paths/point_prefixes.cl,
// point_join.cl), and the numbers that those kernels take. There is no float3, bool, size_t or pointer; padding is
// explicit.
#ifndef WAVETRACER_DEVICE_POINTS_H
#define WAVETRACER_DEVICE_POINTS_H
#include "wavetracer/device/types.h"

// Tiles of a surface that follow each other are near each other. So many of them are a block, with one box around it.
#define WT_TILE_BLOCK 64u

// The most power that an edge diffracts, over that of the wave on a mirror of the same length: the wave of an edge has
// four terms, each of at most half of the amplitude.
#define WT_MOST_OF_EDGE 4.0

// A prefix of an end that sees a point: a tile. Its vertices are a row of solved paths that ends at the tile.
typedef struct {
  double spread;  // 1 / the square of its unfolded length, times WT_MOST_OF_EDGE over an edge
  wt_uint row;
  wt_uint end;            // a place in the list of ends (radio_ends.hpp)
  wt_uint depth;          // the number of vertices; the tile is one
  wt_uint transmissions;  // the number of those that are transmissions
  wt_uint quarters;       // quarters that found it
  wt_uint diffractions;   // the number of those that are diffractions
} wt_point_prefix;

// The key that sorts such prefixes: the tile, then the side of it that they see.
inline wt_uint wt_point_key(wt_uint tile, wt_uint side) { return tile << 1 | side; }
inline wt_uint wt_tile_of_key(wt_uint key) { return key >> 1; }

typedef struct {
  wt_uint node_count;
  wt_uint reflections;           // the most mirrors of a prefix
  wt_uint first_tile, end_tile;  // tiles that are looked for
  wt_uint capacity;
  wt_uint lanes;  // work-items of a node, which share its blocks of tiles
} wt_onlookers_arguments;

typedef struct {
  wt_uint entry_count;
  wt_uint row_count;
  wt_uint rows_per_item;
  wt_uint max_depth;  // vertices that a row has room for
  wt_uint capacity;
} wt_point_prefixes_arguments;

typedef struct {
  double floor;  // paths that are surely weaker are left out; only with powers of tiles
  wt_uint count;
  wt_uint first, end;  // prefixes that serve as those of transmitters
  wt_uint lanes;       // work-items of a prefix
  wt_uint hidden;      // the key from which on prefixes are hidden
  wt_uint transmitter_count;
  wt_uint groups;         // groups of 16 receivers
  wt_uint max_depth;      // the most interactions of a path
  wt_uint transmissions;  // the most transmissions of a path
  wt_uint row_depth;      // vertices that a row has room for
  wt_uint capacity;
  wt_uint diffractions;  // the most diffractions of a path
} wt_point_join_arguments;

// Paths over points of targets (kernels/paths/targets.cl).
typedef struct {
  double floor;  // paths that are surely weaker are left out; only with powers of points
  wt_uint row_count;
  wt_uint rows_per_item;
  wt_uint points;
  wt_uint max_depth;
  wt_uint capacity;  // room for rows where rows that are surely hidden are left out
  wt_uint padding;
} wt_targets_arguments;

// The most facets in a chain of bounces within a body: all but one are mirrors, and one scatters.
#define WT_MOST_BOUNCES 3u

// A chain of bounces (kernels/paths/target_bounces.cl): mirrors of a body, in their order from an end, and the piece of
// it that scatters after them.
typedef struct {
  wt_uint point;       // the piece: a point of a target
  wt_uint count;       // the number of mirrors
  wt_uint mirrors[2];  // surfaces of the world
} wt_target_bounce;

typedef struct {
  double floor;  // paths that are surely weaker are left out; only with powers of points
  wt_ulong first_row, end_row;
  wt_uint bounces;  // the number of chains
  wt_uint rows_per_item;
  wt_uint max_depth;  // vertices that a row has room for
  wt_uint capacity;
} wt_target_bounces_arguments;

#endif
