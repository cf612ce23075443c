// SPDX-License-Identifier: Apache-2.0
// Turns a launch index into a direction, a pure function with the same bits on the host, on CPUs and on GPUs: it uses +
// - * / sqrt and fma only. C++ compiles it for one ray, OpenCL C for one ray or for 16 at once with WT_LANES 16. It
// assumes no contraction.
#ifndef WAVETRACER_DEVICE_DIRECTIONS_H
#define WAVETRACER_DEVICE_DIRECTIONS_H

#include "wavetracer/device/curves.h"
#include "wavetracer/device/direction_maps.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// The mixing function of splitmix64 (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators",
// OOPSLA 2014).
inline WT_U64 wt_mix64(WT_U64 x) {
  x ^= x >> 30;
  x *= (WT_U64)(0xBF58476D1CE4E5B9ul);
  x ^= x >> 27;
  x *= (WT_U64)(0x94D049BB133111EBul);
  return x ^ (x >> 31);
}

// The 16 bits of a word in reverse order.
inline WT_U32 wt_reverse16(WT_U32 x) {
  x = ((x & 0x5555u) << 1) | ((x >> 1) & 0x5555u);
  x = ((x & 0x3333u) << 2) | ((x >> 2) & 0x3333u);
  x = ((x & 0x0F0Fu) << 4) | ((x >> 4) & 0x0F0Fu);
  return ((x & 0x00FFu) << 8) | (x >> 8);
}

// Directions that are born in order. The cylinder (azimuth, height) of equal shares is cut into `faces` rectangles side
// by side, and each of them into 4^level cells along a Hilbert curve. Ray i of n takes cell floor((i + 1/2) cells / n),
// so a range of indices is a compact solid angle of equal share. Inside cell (x, y) of its face a ray sits at
// (reverse(y), reverse(x)): the points of a face are a Hammersley net (J. Hammersley, 1960), so azimuths and heights
// are each evenly spread. Walls are narrow in azimuth and tall, and many of them would be missed if all rays of a row
// had the height of the cell's centre. step = floor((2^64 - 1) / n); host/passes/generate_rays.cpp chooses faces
// 4^level >= n.
inline void wt_place_hilbert(WT_U64 i, WT_U64 step, unsigned level, unsigned faces, WT_U32* height, WT_U32* turn) {
  const WT_U64 cell = ((i * step + (step >> 1)) >> 32) * (WT_U64)((unsigned long)faces << (2u * level)) >> 32;
  const WT_U32 face = WT_TO_U32(cell >> (2u * level));
  const unsigned below = 16u - level;
  WT_U32 x, y;
  wt_hilbert_cell(WT_TO_U32(cell) << (2u * below - (level == 0u)) << (level == 0u), &x, &y);
  x = x >> below;
  y = y >> below;
  const WT_U32 half_cell = (WT_U32)(1u << (2u * below - 1u));
  const WT_U32 column = (((x << level) | (wt_reverse16(y) >> below)) << (2u * below)) + half_cell;
  *height = (((y << level) | (wt_reverse16(x) >> below)) << (2u * below)) + half_cell;
  const unsigned width = (unsigned)(4294967295u / faces);
  *turn = face * width + WT_TO_U32(WT_TO_U64(column) * width >> 32);
}

// The Fibonacci lattice: equal steps in z, golden-ratio turns. 2^64 / golden ratio = 0x9E3779B97F4A7C15.
inline void wt_place_fibonacci(WT_U64 i, WT_U64 step, unsigned level, unsigned faces, WT_U32* height, WT_U32* turn) {
  (void)level, (void)faces;
  *height = WT_TO_U32((i * step + (step >> 1)) >> 32);
  *turn = WT_TO_U32((i * (WT_U64)(0x9E3779B97F4A7C15ul)) >> 32);
}

// Independent uniform directions by a counter-based generator, so ray i of a seed is always the same.
inline void wt_place_random(WT_U64 i, WT_U64 seed, unsigned level, unsigned faces, WT_U32* height, WT_U32* turn) {
  (void)level, (void)faces;
  const WT_U64 bits = wt_mix64(wt_mix64(i + (WT_U64)(0x9E3779B97F4A7C15ul)) ^ seed);
  *height = WT_TO_U32(bits >> 32);
  *turn = WT_TO_U32(bits & 0xFFFFFFFFu);
}

// The direction of a place. by_table: the table says how heights are spread. The launch "horizon" uses that: it has the
// places of hilbert, dense towards the horizon, see host/simulation/launch_slopes.hpp. Else directions are uniform.
inline wt_direction wt_spread(WT_U32 height, WT_U32 turn, unsigned by_table, WT_TABLE heights, WT_U32 table) {
  return by_table ? wt_cylinder_to_heights(height, turn, heights, table) : wt_cylinder_to_sphere(height, turn);
}

// A window is the part of all directions through which an antenna far outside of a scene launches, see
// host/simulation/launch_windows.hpp. After the heights of its table come the width of its azimuths (in units of 2^-32
// turns; they lie around the first axis), how far along that axis its rays start, and the axes of its own frame.
#define WT_WINDOW_WIDTH (WT_HEIGHT_CELLS + 1u)
#define WT_WINDOW_AHEAD (WT_HEIGHT_CELLS + 2u)
#define WT_WINDOW_AXES (WT_HEIGHT_CELLS + 3u)
#define WT_WINDOW_END (WT_HEIGHT_CELLS + 12u)

// The ray at this place of the cylinder, through the window of this table: its direction and its start, as a difference
// from the point that lies `ahead` of the antenna along the first axis. All rays start on a sphere around the antenna.
// In float32 coordinates around the antenna, a scene as far away as from a satellite would lose some centimetres.
typedef struct {
  wt_direction along, start;
} wt_window_ray;

inline wt_window_ray wt_through_window(WT_U32 height, WT_U32 turn, WT_TABLE tables, WT_U32 table) {
  const WT_U32 width = WT_TO_U32(wt_gather(tables, table + WT_WINDOW_WIDTH));
  const WT_U32 azimuth = WT_TO_U32(WT_TO_U64(turn) * WT_TO_U64(width) >> 32) - (width >> 1);
  const wt_direction d = wt_cylinder_to_heights(height, azimuth, tables, table);
  const WT_F32 ahead = wt_gather(tables, table + WT_WINDOW_AHEAD);
  const WT_F32 less = -(d.y * d.y + d.z * d.z) / (1.0f + d.x);  // this is x - 1 without cancellation
  WT_F32 along[3], start[3];
  for (unsigned axis = 0; axis < 3; ++axis) {
    const WT_F32 x = wt_gather(tables, table + (WT_WINDOW_AXES + axis));
    const WT_F32 y = wt_gather(tables, table + (WT_WINDOW_AXES + 3u + axis));
    const WT_F32 z = wt_gather(tables, table + (WT_WINDOW_AXES + 6u + axis));
    const WT_F32 beside = fma(y, d.y, z * d.z);
    along[axis] = fma(x, d.x, beside);
    start[axis] = ahead * fma(x, less, beside);
  }
  wt_window_ray out;
  out.along.x = along[0], out.along.y = along[1], out.along.z = along[2];
  out.start.x = start[0], out.start.y = start[1], out.start.z = start[2];
  return out;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
