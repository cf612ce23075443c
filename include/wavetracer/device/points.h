// SPDX-License-Identifier: Apache-2.0
// Records of paths over points that are joined from prefixes of both ends (kernels/paths/point_prefixes.cl,
// point_join.cl), and the numbers that those kernels take. There is no float3, bool, size_t or pointer; padding is
// explicit.
#ifndef WAVETRACER_DEVICE_POINTS_H
#define WAVETRACER_DEVICE_POINTS_H
#include "wavetracer/device/types.h"

// Tiles of a surface that follow each other are near each other. So many of them are a block, with one box around it.
#define WT_TILE_BLOCK 64u

// The most power that an edge diffracts, over that of the wave on a mirror of the same length. The wave of an edge has
// four terms. Each of the two of the wave itself is half of its jump, which is 2 at most, where a wall lets through its
// opposite; each of the two of reflected waves is three halves at most (lib/bend_bound.clh).
#define WT_MOST_OF_EDGE 25.0

// tile_edges takes tiles in an order in which neighbours follow each other. So many of them have a ball around them,
// and so many such balls have one again.
#define WT_TILE_BALL 32u

// A ball around the tiles that paths over edges may need. sent, heard: bounds of the gains of their paths if the way
// over the edge is 1 m long, and the other way that of an end that sends or of one that receives.
typedef struct {
  float middle[3];
  float radius;
  float sent, heard;
} wt_tile_ball;

// The gain over the way between an end and a tile, 1 / length^2, that the halves of a path need to be above the floor:
// the least one, whatever the other end is, and the least one for all other ends than that. sent, heard: where the
// other end sends, or receives.
typedef struct {
  double sent[2];
  double heard[2];
  wt_uint sender, receiver;  // the number of that other end among transmitters or receivers; WT_NONE if there is none
} wt_point_floor;

// A prefix of an end that sees a point: a tile. Its vertices are a row of solved paths that ends at the tile.
typedef struct {
  double spread;  // a bound of its power: 1 / the square of its unfolded length, at most WT_MOST_OF_EDGE times that
                  // over an edge
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
  wt_uint transmitter_count;
  wt_uint groups;  // groups of 16 receivers
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
  wt_uint bends;         // the fewest diffractions of a path
  wt_uint padding;
} wt_point_join_arguments;

// Numbers for tile_edges: `lanes` work-items take each of the prefixes first to end - 1, in their order.
typedef struct {
  double floor;   // paths that are surely weaker are left out; 0: none are
  double wave_m;  // the wavelength, four times that where surfaces pass waves (bend_floors.hpp)
  wt_uint first, end, lanes;
  wt_uint balls;   // balls of tiles
  wt_uint places;  // prefixes that see tiles
  wt_uint transmitter_count;
  wt_uint groups;        // groups of 16 receivers
  wt_uint interactions;  // the most of a way to a tile, its edge included
  wt_uint max_depth;     // the most interactions of a path
  wt_uint capacity;
  float end_detour_m;  // the detour over a free end of an edge up to which there are paths
  wt_uint padding;
} wt_tile_edges_arguments;

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
