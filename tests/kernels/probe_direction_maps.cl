// SPDX-License-Identifier: Apache-2.0
// Kernels that only tests run: the maps of wavetracer/device/direction_maps.h, whose results a host compares with its
// own. Planes of n words or floats, component d of element i at d * n + i; n is a multiple of WT_LANES, 1 or 16.
#include "wavetracer/device/direction_maps.h"

#if WT_LANES == 16
#define WT_LOAD(from) vload16(0, from)
#define WT_STORE(value, to) vstore16(value, 0, to)
#else
#define WT_LOAD(from) (*(from))
#define WT_STORE(value, to) (*(to) = (value))
#endif

// Five planes of words: the cylinder's height and turn, the octahedron's cell, the bin of x.
kernel void directions_to_words(const global float* directions, uint n, uint level, uint bins, global uint* words) {
  const size_t i = get_global_id(0) * WT_LANES;
  if (i >= n) return;
  wt_direction d;
  d.x = WT_LOAD(directions + i);
  d.y = WT_LOAD(directions + n + i);
  d.z = WT_LOAD(directions + 2 * (size_t)n + i);
  WT_U32 height, turn, x, y;
  wt_sphere_to_cylinder(d, &height, &turn);
  wt_octahedron_encode(d, level, &x, &y);
  WT_STORE(height, words + i);
  WT_STORE(turn, words + n + i);
  WT_STORE(x, words + 2 * (size_t)n + i);
  WT_STORE(y, words + 3 * (size_t)n + i);
  WT_STORE(wt_cube_cell(d.x, bins), words + 4 * (size_t)n + i);
}

// The centres of octahedral cells.
kernel void cells_to_directions(const global uint* cells, uint n, uint level, global float* directions) {
  const size_t i = get_global_id(0) * WT_LANES;
  if (i >= n) return;
  const wt_direction d = wt_octahedron_decode(WT_LOAD(cells + i), WT_LOAD(cells + n + i), level);
  WT_STORE(d.x, directions + i);
  WT_STORE(d.y, directions + n + i);
  WT_STORE(d.z, directions + 2 * (size_t)n + i);
}
