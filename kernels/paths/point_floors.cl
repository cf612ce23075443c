// SPDX-License-Identifier: Apache-2.0
// point_floors: the gain that ways between ends and tiles need for a path above the floor, so that point_prefixes
// leaves out others before they are solved. No way from a tile to another end is shorter than the straight one.
#include "lib/tile.clh"
#include "wavetracer/device/points.h"
#pragma OPENCL FP_CONTRACT OFF

// The squares of the distances of the nearest two ends, and the number of the nearest.
typedef struct {
  double first, second;
  uint number;
} nearest_ends;

inline nearest_ends nearest_to(double3 p, const global double4* ends, uint count) {
  nearest_ends out = {INFINITY, INFINITY, WT_NONE};
  for (uint i = 0; i < count; ++i) {
    const double3 way = ends[i].xyz - p;
    const double square = wt_dot(way, way);
    if (square < out.first) {
      out.second = out.first;
      out.first = square;
      out.number = i;
    } else {
      out.second = fmin(out.second, square);
    }
  }
  return out;
}

// A work-item takes one tile. powers: for each tile a bound of the gain of paths over it whose parts are 1 m long;
// least_gain: the gain that a path needs, less than rounding below it, over the most that an edge on the other way
// adds.
kernel void point_floors(const global double4* transmitters, const global double4* receivers,
                         const global uint4* tiles_of, const global uint* surface_of_tile, const global double* centres,
                         const global wt_exact_surface* surfaces, const global wt_exact_instance* instances,
                         const global double* powers, global wt_point_floor* out, uint tile_count,
                         uint transmitter_count, uint receiver_count, double least_gain) {
  const uint tile = get_global_id(0);
  if (tile >= tile_count) return;
  const uint surface = surface_of_tile[tile];
  const uint4 tiles = tiles_of[surface];
  const double3 p = wt_tile_centre(centres, instances, surfaces[surface].instance, tiles.y + tile - tiles.x);
  const nearest_ends sender = nearest_to(p, transmitters, transmitter_count);
  const nearest_ends receiver = nearest_to(p, receivers, receiver_count);
  const double needed = least_gain / powers[tile];
  out[tile].sent[0] = needed * sender.first;
  out[tile].sent[1] = needed * sender.second;
  out[tile].heard[0] = needed * receiver.first;
  out[tile].heard[1] = needed * receiver.second;
  out[tile].sender = sender.number;
  out[tile].receiver = receiver.number;
}
