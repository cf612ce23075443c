// SPDX-License-Identifier: Apache-2.0
// Morton and Hilbert curves: cells to codes and back, without tables or branches, for any number of lanes.
// Components and codes must fit into the bits stated; Morton curves ignore higher bits, Hilbert curves do not.
#ifndef WAVETRACER_DEVICE_CURVES_H
#define WAVETRACER_DEVICE_CURVES_H
#include "wavetracer/device/lanes.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// Morton curves (G. Morton, 1966). Each group of bits holds one bit of every component; x is the least significant of
// its group. Components have 32 bits in 2D, 21 in 3D, 12 in 5D. Spreading moves halves of halves apart, and gathering
// undoes it (H. Warren, "Hacker's Delight", 7-2).

inline WT_U64 wt_spread2(WT_U32 word) {
  WT_U64 x = WT_TO_U64(word);
  x = (x | (x << 16)) & 0x0000FFFF0000FFFFul;
  x = (x | (x << 8)) & 0x00FF00FF00FF00FFul;
  x = (x | (x << 4)) & 0x0F0F0F0F0F0F0F0Ful;
  x = (x | (x << 2)) & 0x3333333333333333ul;
  return (x | (x << 1)) & 0x5555555555555555ul;
}

inline WT_U32 wt_gather2(WT_U64 x) {
  x &= 0x5555555555555555ul;
  x = (x | (x >> 1)) & 0x3333333333333333ul;
  x = (x | (x >> 2)) & 0x0F0F0F0F0F0F0F0Ful;
  x = (x | (x >> 4)) & 0x00FF00FF00FF00FFul;
  x = (x | (x >> 8)) & 0x0000FFFF0000FFFFul;
  return WT_TO_U32((x | (x >> 16)) & 0x00000000FFFFFFFFul);
}

inline WT_U64 wt_spread3(WT_U32 word) {
  WT_U64 x = WT_TO_U64(word & 0x1FFFFFu);
  x = (x | (x << 32)) & 0x001F00000000FFFFul;
  x = (x | (x << 16)) & 0x001F0000FF0000FFul;
  x = (x | (x << 8)) & 0x100F00F00F00F00Ful;
  x = (x | (x << 4)) & 0x10C30C30C30C30C3ul;
  return (x | (x << 2)) & 0x1249249249249249ul;
}

inline WT_U32 wt_gather3(WT_U64 x) {
  x &= 0x1249249249249249ul;
  x = (x | (x >> 2)) & 0x10C30C30C30C30C3ul;
  x = (x | (x >> 4)) & 0x100F00F00F00F00Ful;
  x = (x | (x >> 8)) & 0x001F0000FF0000FFul;
  x = (x | (x >> 16)) & 0x001F00000000FFFFul;
  return WT_TO_U32((x | (x >> 32)) & 0x00000000001FFFFFul);
}

inline WT_U64 wt_spread5(WT_U32 word) {
  WT_U64 x = WT_TO_U64(word & 0xFFFu);
  x = (x | (x << 32)) & 0x00000F00000000FFul;
  x = (x | (x << 16)) & 0x00000F0000F0000Ful;
  x = (x | (x << 8)) & 0x000C0300C0300C03ul;
  return (x | (x << 4)) & 0x0084210842108421ul;
}

inline WT_U32 wt_gather5(WT_U64 x) {
  x &= 0x0084210842108421ul;
  x = (x | (x >> 4)) & 0x000C0300C0300C03ul;
  x = (x | (x >> 8)) & 0x00000F0000F0000Ful;
  x = (x | (x >> 16)) & 0x00000F00000000FFul;
  return WT_TO_U32((x | (x >> 32)) & 0x0000000000000FFFul);
}

// The same in 32-bit words: components have 16 bits in 2D, 10 in 3D.

inline WT_U32 wt_spread2_short(WT_U32 x) {
  x &= 0x0000FFFFu;
  x = (x | (x << 8)) & 0x00FF00FFu;
  x = (x | (x << 4)) & 0x0F0F0F0Fu;
  x = (x | (x << 2)) & 0x33333333u;
  return (x | (x << 1)) & 0x55555555u;
}

inline WT_U32 wt_gather2_short(WT_U32 x) {
  x &= 0x55555555u;
  x = (x | (x >> 1)) & 0x33333333u;
  x = (x | (x >> 2)) & 0x0F0F0F0Fu;
  x = (x | (x >> 4)) & 0x00FF00FFu;
  return (x | (x >> 8)) & 0x0000FFFFu;
}

inline WT_U32 wt_spread3_short(WT_U32 x) {
  x &= 0x000003FFu;
  x = (x | (x << 16)) & 0x030000FFu;
  x = (x | (x << 8)) & 0x0300F00Fu;
  x = (x | (x << 4)) & 0x030C30C3u;
  return (x | (x << 2)) & 0x09249249u;
}

inline WT_U64 wt_morton2_encode(WT_U32 x, WT_U32 y) { return wt_spread2(x) | (wt_spread2(y) << 1); }

inline void wt_morton2_decode(WT_U64 code, WT_U32* x, WT_U32* y) {
  *x = wt_gather2(code);
  *y = wt_gather2(code >> 1);
}

inline WT_U64 wt_morton3_encode(WT_U32 x, WT_U32 y, WT_U32 z) {
  return wt_spread3(x) | (wt_spread3(y) << 1) | (wt_spread3(z) << 2);
}

inline void wt_morton3_decode(WT_U64 code, WT_U32* x, WT_U32* y, WT_U32* z) {
  *x = wt_gather3(code);
  *y = wt_gather3(code >> 1);
  *z = wt_gather3(code >> 2);
}

inline WT_U64 wt_morton5_encode(WT_U32 x, WT_U32 y, WT_U32 z, WT_U32 u, WT_U32 v) {
  return wt_spread5(x) | (wt_spread5(y) << 1) | (wt_spread5(z) << 2) | (wt_spread5(u) << 3) | (wt_spread5(v) << 4);
}

inline void wt_morton5_decode(WT_U64 code, WT_U32* x, WT_U32* y, WT_U32* z, WT_U32* u, WT_U32* v) {
  *x = wt_gather5(code);
  *y = wt_gather5(code >> 1);
  *z = wt_gather5(code >> 2);
  *u = wt_gather5(code >> 3);
  *v = wt_gather5(code >> 4);
}

// Components have 16 bits.
inline WT_U32 wt_morton2_encode32(WT_U32 x, WT_U32 y) { return wt_spread2_short(x) | (wt_spread2_short(y) << 1); }

// Components have 10 bits.
inline WT_U32 wt_morton3_encode32(WT_U32 x, WT_U32 y, WT_U32 z) {
  return wt_spread3_short(x) | (wt_spread3_short(y) << 1) | (wt_spread3_short(z) << 2);
}

// Hilbert curves with `level` bits for each component. They start at the origin; the first step of the coarsest level
// goes along the last component; x is the leading bit of every digit. Levels nest: a code without its last digit is the
// code of the enclosing cell, one level up.

// Bit i of the result is the parity of the bits i and above.
inline WT_U32 wt_parity_prefix(WT_U32 x) {
  x ^= x >> 16;
  x ^= x >> 8;
  x ^= x >> 4;
  x ^= x >> 2;
  return x ^ (x >> 1);
}

// The cell of a 2D Hilbert code whose digits have these low and high bits. The orientation of a level is the parity of
// the swaps and flips of the levels above it, so all levels are decoded at once by two parity prefixes: the log-depth
// form of "2D Hilbert curves in O(1)", threadlocalmutex.com, 2015. An even number of zero digits in front changes
// nothing.
inline void wt_hilbert2_cell(WT_U32 low, WT_U32 high, WT_U32* x, WT_U32* y) {
  const WT_U32 swaps = wt_parity_prefix(~(low | high));
  const WT_U32 flips = wt_parity_prefix(low & high);
  const WT_U32 a = (~low & flips) | (low & swaps);
  *x = a ^ high;
  *y = a ^ low ^ high;
}

// The inverse: the high bits of the digits of a cell's code; the low bits are x ^ y. With F and S for flips and swaps,
// a digit with low bit 0 takes (F, S) to (F, F + S + x + 1), one with low bit 1 to (F + S + x, S), modulo 2. Where the
// pair is exchanged at every other level, the linear parts are w and w^2 of the field of four elements (of matrices
// p + q w, with w^2 = 1 + w), and maps (p, q, F, S) are composed over spans of 1, 2, 4, 8 and 16 levels.
inline WT_U32 wt_hilbert2_high_bits(WT_U32 x, WT_U32 y) {
  const WT_U32 low = x ^ y;
  WT_U32 p = low ^ 0xAAAAAAAAu, q = (WT_U32)(0xFFFFFFFFu);
  WT_U32 flips = low & x, swaps = ~(low | x);
  WT_U32 exchanged = (flips ^ swaps) & 0xAAAAAAAAu;
  flips ^= exchanged;
  swaps ^= exchanged;
  for (unsigned span = 1; span < 32u; span *= 2u) {
    const WT_U32 above_p = p >> span, above_q = q >> span, above_flips = flips >> span, above_swaps = swaps >> span;
    flips ^= (p & above_flips) ^ (q & above_swaps);
    swaps ^= (q & above_flips) ^ ((p ^ q) & above_swaps);
    const WT_U32 both = q & above_q;
    q = (p & above_q) ^ (q & above_p) ^ both;
    p = (p & above_p) ^ both;
  }
  exchanged = (flips ^ swaps) & 0xAAAAAAAAu;
  return x ^ (low & (swaps ^ exchanged)) ^ (~low & (flips ^ exchanged));
}

// level is at most 32.
inline WT_U64 wt_hilbert2_encode(WT_U32 x, WT_U32 y, unsigned level) {
  const unsigned odd = level & 1u;
  x = x << odd;
  y = y << odd;
  return wt_morton2_encode(x ^ y, wt_hilbert2_high_bits(x, y)) >> (2u * odd);
}

inline void wt_hilbert2_decode(WT_U64 code, unsigned level, WT_U32* x, WT_U32* y) {
  const unsigned odd = level & 1u;
  code = code << (2u * odd);
  wt_hilbert2_cell(wt_gather2(code), wt_gather2(code >> 1), x, y);
  *x = *x >> odd;
  *y = *y >> odd;
}

// level is at most 16.
inline WT_U32 wt_hilbert2_encode32(WT_U32 x, WT_U32 y, unsigned level) {
  const unsigned odd = level & 1u;
  x = x << odd;
  y = y << odd;
  return wt_morton2_encode32(x ^ y, wt_hilbert2_high_bits(x, y)) >> (2u * odd);
}

// Turns an index along the curve of 2^16 x 2^16 cells into its cell.
inline void wt_hilbert_cell(WT_U32 index, WT_U32* x, WT_U32* y) {
  wt_hilbert2_cell(wt_gather2_short(index), wt_gather2_short(index >> 1), x, y);
}

// The 3D curve is that of J. Skilling, "Programming the Hilbert curve", AIP Conf. Proc. 707, 381 (2004). This function
// does with masks what a digit does to the levels below it: where the bits of *other that `set` marks are one, the
// leading component is inverted, else the two are exchanged. `set` is 0 or `below`, the mask of the lower bits.
inline void wt_hilbert3_turn(WT_U32* leading, WT_U32* other, WT_U32 set, unsigned below) {
  const WT_U32 exchanged = (*leading ^ *other) & (set ^ below);
  *leading ^= exchanged ^ set;
  *other ^= exchanged;
}

// Turns one bit of every lane's word into a mask: 0 or all of `below`.
inline WT_U32 wt_bit_mask(WT_U32 word, unsigned bit, unsigned below) { return (0u - ((word >> bit) & 1u)) & below; }

// Turns cells into codes and back in Skilling's transposed form: each word holds its bit of every digit, x the leading
// one.
inline void wt_hilbert3_transpose(WT_U32* x, WT_U32* y, WT_U32* z, unsigned level) {
  for (unsigned bit = level; bit-- > 1u;) {
    const unsigned below = (1u << bit) - 1u;
    const WT_U32 set_y = wt_bit_mask(*y, bit, below), set_z = wt_bit_mask(*z, bit, below);
    *x ^= wt_bit_mask(*x, bit, below);
    wt_hilbert3_turn(x, y, set_y, below);
    wt_hilbert3_turn(x, z, set_z, below);
  }
  *y ^= *x;
  *z ^= *y;
  const WT_U32 odd = wt_parity_prefix(*z >> 1);
  *x ^= odd;
  *y ^= odd;
  *z ^= odd;
}

inline void wt_hilbert3_untranspose(WT_U32* x, WT_U32* y, WT_U32* z, unsigned level) {
  const WT_U32 gray = *z >> 1;
  *z ^= *y;
  *y ^= *x;
  *x ^= gray;
  for (unsigned bit = 1u; bit < level; ++bit) {
    const unsigned below = (1u << bit) - 1u;
    wt_hilbert3_turn(x, z, wt_bit_mask(*z, bit, below), below);
    wt_hilbert3_turn(x, y, wt_bit_mask(*y, bit, below), below);
    *x ^= wt_bit_mask(*x, bit, below);
  }
}

// level is at most 21.
inline WT_U64 wt_hilbert3_encode(WT_U32 x, WT_U32 y, WT_U32 z, unsigned level) {
  wt_hilbert3_transpose(&x, &y, &z, level);
  return wt_morton3_encode(z, y, x);
}

inline void wt_hilbert3_decode(WT_U64 code, unsigned level, WT_U32* x, WT_U32* y, WT_U32* z) {
  wt_morton3_decode(code, z, y, x);
  wt_hilbert3_untranspose(x, y, z, level);
}

// level is at most 10.
inline WT_U32 wt_hilbert3_encode32(WT_U32 x, WT_U32 y, WT_U32 z, unsigned level) {
  wt_hilbert3_transpose(&x, &y, &z, level);
  return wt_morton3_encode32(z, y, x);
}

// The cells of a box of up to five dimensions: cell 0 begins at `lower`, and `scale` cells are one unit long. `cells`
// is their number in each dimension, as a float, and `last` the last one.
typedef struct {
  float lower[5];
  float scale[5];
  float cells;
  unsigned last;
} wt_curve_box;

// The cell of a component in its dimension of a box. The upper face belongs to the last cell; values outside go to the
// nearest cell, NaN to the first.
inline WT_U32 wt_box_cell(WT_F32 component, float lower, float scale, float cells, unsigned last) {
  const WT_F32 place = (component - lower) * scale;
  const WT_F32 above = place > 0.0f ? place : (WT_F32)(0.0f);
  const WT_U32 cell = WT_TO_U32(above < cells ? above : (WT_F32)(0.0f));
  return above < cells ? cell : (WT_U32)(last);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
