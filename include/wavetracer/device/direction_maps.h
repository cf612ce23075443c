// SPDX-License-Identifier: Apache-2.0
// Maps between unit directions and the plane, for any number of lanes: equal-area cylinder, octahedron, cube cells.
// They use + - * / sqrt fma and integers only, so host, CPUs and GPUs agree bit for bit. They assume no contraction.
#ifndef WAVETRACER_DEVICE_DIRECTION_MAPS_H
#define WAVETRACER_DEVICE_DIRECTION_MAPS_H
#include "wavetracer/device/lanes.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

typedef struct {
  WT_F32 x, y, z;
} wt_direction;

// Sine and cosine of angle + pi/4 for |angle| <= pi/4, by Taylor polynomials with an error below 1e-7.
inline void wt_sincos_eighth(WT_F32 angle, WT_F32* sine, WT_F32* cosine) {
  const WT_F32 q = angle * angle;
  WT_F32 s = fma(q, (WT_F32)(2.7557319e-6f), (WT_F32)(-1.9841270e-4f));
  s = fma(q, s, (WT_F32)(8.3333333e-3f));
  s = fma(q, s, (WT_F32)(-1.6666667e-1f));
  s = fma(q * angle, s, angle);
  WT_F32 c = fma(q, (WT_F32)(2.4801587e-5f), (WT_F32)(-1.3888889e-3f));
  c = fma(q, c, (WT_F32)(4.1666667e-2f));
  c = fma(q, c, (WT_F32)(-0.5f));
  c = fma(q, c, (WT_F32)(1.0f));
  *sine = (c + s) * 0.70710678f;
  *cosine = (c - s) * 0.70710678f;
}

// The direction with this z; its azimuth is a fraction of a turn, in units of 2^-32.
inline wt_direction wt_at_height(WT_F32 z, WT_U32 turn) {
  WT_F32 sine, cosine;
  wt_sincos_eighth(fma(WT_TO_F32(turn & 0x3FFFFFFFu), (WT_F32)(1.4629180e-9f), (WT_F32)(-0.78539816f)), &sine, &cosine);
  const WT_F32 radius = sqrt(fabs(1.0f - z * z));
  const WT_U32 quadrant = turn >> 30;
  const WT_F32 x = (quadrant & 1u) == 0u ? cosine : -sine;
  const WT_F32 y = (quadrant & 1u) == 0u ? sine : cosine;
  wt_direction out;
  out.x = radius * ((quadrant & 2u) == 0u ? x : -x);
  out.y = radius * ((quadrant & 2u) == 0u ? y : -y);
  out.z = z;
  return out;
}

// The cylindrical equal-area map: z from the height, azimuth from the turn, both fractions in units of 2^-32.
inline wt_direction wt_cylinder_to_sphere(WT_U32 height, WT_U32 turn) {
  return wt_at_height(1.0f - (WT_TO_F32(height) + 0.5f) * 4.6566129e-10f, turn);
}

// The same with another distribution of heights: heights[table + k] is the z below which the share 1 - k /
// WT_HEIGHT_CELLS of all directions lies, for k = 0 (z = 1) to WT_HEIGHT_CELLS (z = -1); z is linear between these.
#define WT_HEIGHT_BITS 9u
#define WT_HEIGHT_CELLS (1u << WT_HEIGHT_BITS)
inline wt_direction wt_cylinder_to_heights(WT_U32 height, WT_U32 turn, WT_TABLE heights, WT_U32 table) {
  const WT_U32 cell = table + (height >> (32u - WT_HEIGHT_BITS));
  const WT_F32 part = (WT_TO_F32(height & ((1u << (32u - WT_HEIGHT_BITS)) - 1u)) + 0.5f) * 1.1920929e-7f;
  const WT_F32 above = wt_gather(heights, cell);
  return wt_at_height(fma(part, wt_gather(heights, cell + 1u) - above, above), turn);
}

// (2 / pi) arctan(t) for |t| <= 1: an odd minimax polynomial that gives exactly 1/2 at 1, with an error below 2e-7.
inline WT_F32 wt_arctan_quadrants(WT_F32 t) {
  const WT_F32 q = t * t;
  WT_F32 a = fma(q, (WT_F32)(4.2414977e-3f), (WT_F32)(-2.1109981e-2f));
  a = fma(q, a, (WT_F32)(5.0368610e-2f));
  a = fma(q, a, (WT_F32)(-8.4072985e-2f));
  a = fma(q, a, (WT_F32)(1.2605582e-1f));
  a = fma(q, a, (WT_F32)(-2.1210010e-1f));
  a = fma(q, a, (WT_F32)(6.3661710e-1f));
  return a * t;
}

// The inverse of the cylindrical map: height and turn of a direction of about unit length, in units of 2^-32. Turns are
// right to 1e-7 of a turn, heights to the rounding of z. The poles have turn 0; NaN gives some height and turn.
inline void wt_sphere_to_cylinder(wt_direction d, WT_U32* height, WT_U32* turn) {
  WT_F32 scaled = (1.0f - d.z) * 2147483648.0f;
  scaled = scaled > 0.0f ? scaled : (WT_F32)(0.0f);
  *height = WT_TO_U32(scaled < 4294967040.0f ? scaled : (WT_F32)(4294967040.0f));
  // Turning by a half and then a quarter turn makes a >= 0 and b >= 0. A quarter ends where the next one has its 0.
  const WT_F32 x = d.y < 0.0f ? -d.x : d.x;
  const WT_F32 y = d.y < 0.0f ? -d.y : d.y;
  const WT_F32 b = x < 0.0f ? -x : y;
  WT_F32 a = x < 0.0f ? y : x;
  a = a > 1e-30f ? a : (WT_F32)(1e-30f);  // the poles need a quotient, too
  const WT_U32 halves = d.y < 0.0f ? (WT_U32)(2u) : (WT_U32)(0u);
  const WT_U32 quarters = x < 0.0f ? (WT_U32)(1u) : (WT_U32)(0u);
  WT_F32 fraction = wt_arctan_quadrants((b - a) / (b + a)) + 0.5f;
  fraction = fraction > 0.0f ? fraction : (WT_F32)(0.0f);
  fraction = fraction < 1.0f ? fraction : (WT_F32)(1.0f);
  *turn = ((halves + quarters) << 30) + WT_TO_U32(fraction * 1073741824.0f);
}

// The bin of a component in [-1, 1] among 1 to 2^23 equal bins; 1 is in the last one. A value outside goes to the
// nearest bin, NaN to the first.
inline WT_U32 wt_cube_cell(WT_F32 component, unsigned bins) {
  const float scale = 0.5f * (float)bins, last = (float)(bins - 1u);
  WT_F32 place = fma(component, (WT_F32)(scale), (WT_F32)(scale));
  place = place > 0.0f ? place : (WT_F32)(0.0f);
  return WT_TO_U32(place < last ? place : (WT_F32)(last));
}

// The octahedral map projects the sphere on |x| + |y| + |z| = 1 and folds the lower half outwards over the square's
// corners (Z. Cigolle et al., "A survey of efficient representations for independent unit vectors", JCGT 3(2), 2014).
// It gives the cell of a direction among 2^level x 2^level, level <= 16, for any length but zero, which gives cell (0,
// 0).
inline void wt_octahedron_encode(wt_direction d, unsigned level, WT_U32* x, WT_U32* y) {
  const WT_F32 length = fabs(d.x) + fabs(d.y) + fabs(d.z);
  const WT_F32 inverse = 1.0f / length;
  const WT_F32 u = d.x * inverse, v = d.y * inverse;
  const WT_F32 folded_u = u < 0.0f ? fabs(v) - 1.0f : 1.0f - fabs(v);
  const WT_F32 folded_v = v < 0.0f ? fabs(u) - 1.0f : 1.0f - fabs(u);
  *x = wt_cube_cell(d.z < 0.0f ? folded_u : u, 1u << level);
  *y = wt_cube_cell(d.z < 0.0f ? folded_v : v, 1u << level);
}

// The direction of a cell's centre.
inline wt_direction wt_octahedron_decode(WT_U32 x, WT_U32 y, unsigned level) {
  const float cell = 1.0f / (float)(1u << level);
  const WT_F32 u = fma(WT_TO_F32(2u * x + 1u), (WT_F32)(cell), (WT_F32)(-1.0f));
  const WT_F32 v = fma(WT_TO_F32(2u * y + 1u), (WT_F32)(cell), (WT_F32)(-1.0f));
  const WT_F32 z = 1.0f - fabs(u) - fabs(v);
  const WT_F32 unfolded_u = u < 0.0f ? fabs(v) - 1.0f : 1.0f - fabs(v);
  const WT_F32 unfolded_v = v < 0.0f ? fabs(u) - 1.0f : 1.0f - fabs(u);
  wt_direction out;
  out.x = z < 0.0f ? unfolded_u : u;
  out.y = z < 0.0f ? unfolded_v : v;
  const WT_F32 length = sqrt(out.x * out.x + out.y * out.y + z * z);
  out.x = out.x / length;
  out.y = out.y / length;
  out.z = z / length;
  return out;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
