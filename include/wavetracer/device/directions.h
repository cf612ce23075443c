// Launch index to direction as a pure function, bit for bit the same on the host, on CPUs and on GPUs: + - * / sqrt and
// fma only. Compiled by C++ (one ray) and OpenCL C (one ray, or 16 at once with WT_DIRECTION_WIDTH 16). Assumes no
// contraction.
#ifndef WAVETRACER_DEVICE_DIRECTIONS_H
#define WAVETRACER_DEVICE_DIRECTIONS_H

#ifdef __OPENCL_VERSION__
#pragma OPENCL FP_CONTRACT OFF
#if defined(WT_DIRECTION_WIDTH) && WT_DIRECTION_WIDTH == 16
#define WT_U32 uint16
#define WT_U64 ulong16
#define WT_F32 float16
#define WT_TO_F32(x) convert_float16(x)
#define WT_TO_U32(x) convert_uint16(x)
#define WT_TO_U64(x) convert_ulong16(x)
#else
#define WT_U32 uint
#define WT_U64 ulong
#define WT_F32 float
#define WT_TO_F32(x) ((float)(x))
#define WT_TO_U32(x) ((uint)(x))
#define WT_TO_U64(x) ((ulong)(x))
#endif
#define WT_DIRECTION_FUNCTION inline
#else
#include <cmath>
#include <cstdint>
#define WT_U32 uint32_t
#define WT_U64 uint64_t
#define WT_F32 float
#define WT_TO_F32(x) static_cast<float>(x)
#define WT_TO_U32(x) static_cast<uint32_t>(x)
#define WT_TO_U64(x) static_cast<uint64_t>(x)
#define WT_DIRECTION_FUNCTION inline
namespace wavetracer::device {
using std::fabs;
using std::fma;
using std::sqrt;
#endif

typedef struct {
  WT_F32 x, y, z;
} wt_direction;

// Even bits of a 32-bit word, packed.
WT_DIRECTION_FUNCTION WT_U32 wt_even_bits(WT_U32 x) {
  x &= 0x55555555u;
  x = (x | (x >> 1)) & 0x33333333u;
  x = (x | (x >> 2)) & 0x0F0F0F0Fu;
  x = (x | (x >> 4)) & 0x00FF00FFu;
  return (x | (x >> 8)) & 0x0000FFFFu;
}

// Parity of all higher bits and the bit itself, 16 bits.
WT_DIRECTION_FUNCTION WT_U32 wt_parity_prefix(WT_U32 x) {
  x ^= x >> 8;
  x ^= x >> 4;
  x ^= x >> 2;
  return x ^ (x >> 1);
}

// Index along the 2D Hilbert curve of 2^16 x 2^16 cells to its cell. The orientation of a level is the parity of the
// swaps and flips of the levels above it, so all levels are decoded at once by two parity prefixes: the log-depth form
// of "2D Hilbert curves in O(1)", threadlocalmutex.com, 2015.
WT_DIRECTION_FUNCTION void wt_hilbert_cell(WT_U32 index, WT_U32* x, WT_U32* y) {
  const WT_U32 low = wt_even_bits(index), high = wt_even_bits(index >> 1);
  const WT_U32 swaps = wt_parity_prefix((low | high) ^ 0xFFFFu);
  const WT_U32 flips = wt_parity_prefix(low & high);
  const WT_U32 a = ((low ^ 0xFFFFu) & flips) | (low & swaps);
  *x = (a ^ high) & 0xFFFFu;
  *y = (a ^ low ^ high) & 0xFFFFu;
}

// sine and cosine of angle + pi/4 for |angle| <= pi/4; Taylor polynomials, error below 1e-7.
WT_DIRECTION_FUNCTION void wt_sincos_eighth(WT_F32 angle, WT_F32* sine, WT_F32* cosine) {
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

// Cylindrical equal-area map: z from the height fraction, azimuth as a fraction of a turn, both in units of 2^-32.
WT_DIRECTION_FUNCTION wt_direction wt_cylinder_to_sphere(WT_U32 height, WT_U32 turn) {
  const WT_F32 z = 1.0f - (WT_TO_F32(height) + 0.5f) * 4.6566129e-10f;
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

// The mixing function of splitmix64 (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators",
// OOPSLA 2014).
WT_DIRECTION_FUNCTION WT_U64 wt_mix64(WT_U64 x) {
  x ^= x >> 30;
  x *= (WT_U64)(0xBF58476D1CE4E5B9ul);
  x ^= x >> 27;
  x *= (WT_U64)(0x94D049BB133111EBul);
  return x ^ (x >> 31);
}

// The 16 bits of a word in reverse order.
WT_DIRECTION_FUNCTION WT_U32 wt_reverse16(WT_U32 x) {
  x = ((x & 0x5555u) << 1) | ((x >> 1) & 0x5555u);
  x = ((x & 0x3333u) << 2) | ((x >> 2) & 0x3333u);
  x = ((x & 0x0F0Fu) << 4) | ((x >> 4) & 0x0F0Fu);
  return ((x & 0x00FFu) << 8) | (x >> 8);
}

// Born in order. The equal-area cylinder (azimuth, z) is cut into `faces` rectangles side by side, each into 4^level
// cells along a Hilbert curve; ray i of n takes cell floor((i + 1/2) cells / n), so index ranges are compact solid
// angles of equal share. Inside cell (x, y) of its face a ray sits at (reverse(y), reverse(x)): the points of a face
// are a Hammersley net (J. Hammersley, 1960), so azimuths and heights are each evenly spread. Walls are narrow in
// azimuth and tall: cell centres, all in one row, would miss many of them. step = floor((2^64 - 1) / n); faces 4^level
// >= n, chosen by host/passes/generate_rays.cpp.
WT_DIRECTION_FUNCTION wt_direction wt_direction_hilbert(WT_U64 i, WT_U64 step, unsigned level, unsigned faces) {
  const WT_U64 cell = ((i * step + (step >> 1)) >> 32) * (WT_U64)((unsigned long)faces << (2u * level)) >> 32;
  const WT_U32 face = WT_TO_U32(cell >> (2u * level));
  const unsigned below = 16u - level;
  WT_U32 x, y;
  wt_hilbert_cell(WT_TO_U32(cell) << (2u * below - (level == 0u)) << (level == 0u), &x, &y);
  x = x >> below;
  y = y >> below;
  const WT_U32 half_cell = (WT_U32)(1u << (2u * below - 1u));
  const WT_U32 column = (((x << level) | (wt_reverse16(y) >> below)) << (2u * below)) + half_cell;
  const WT_U32 row = (((y << level) | (wt_reverse16(x) >> below)) << (2u * below)) + half_cell;
  const unsigned width = (unsigned)(4294967295u / faces);
  return wt_cylinder_to_sphere(row, face * width + WT_TO_U32(WT_TO_U64(column) * width >> 32));
}

// Fibonacci lattice: equal steps in z, golden-ratio turns. 2^64 / golden ratio = 0x9E3779B97F4A7C15.
WT_DIRECTION_FUNCTION wt_direction wt_direction_fibonacci(WT_U64 i, WT_U64 step, unsigned level, unsigned faces) {
  (void)level, (void)faces;
  return wt_cylinder_to_sphere(WT_TO_U32((i * step + (step >> 1)) >> 32),
                               WT_TO_U32((i * (WT_U64)(0x9E3779B97F4A7C15ul)) >> 32));
}

// Independent uniform directions: a counter-based generator, so ray i of a seed is always the same.
WT_DIRECTION_FUNCTION wt_direction wt_direction_random(WT_U64 i, WT_U64 seed, unsigned level, unsigned faces) {
  (void)level, (void)faces;
  const WT_U64 bits = wt_mix64(wt_mix64(i + (WT_U64)(0x9E3779B97F4A7C15ul)) ^ seed);
  return wt_cylinder_to_sphere(WT_TO_U32(bits >> 32), WT_TO_U32(bits & 0xFFFFFFFFu));
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
