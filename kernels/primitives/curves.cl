// SPDX-License-Identifier: Apache-2.0
// curves: points to keys along a space-filling curve, cells to codes, and codes to cells. Point i is the WT_DIMENSIONS
// floats from points[i * stride] on; component d of cell i is word d * stride + i. The host names the curve by
// WT_ENCODE and WT_DECODE, and the bits of a key by WT_KEY_BITS; a work-item has WT_LANES points; level is that of
// Hilbert curves.
#include "wavetracer/device/curves.h"

inline WT_U64 wt_encode_morton2(const WT_U32* p, uint level) { return wt_morton2_encode(p[0], p[1]); }
inline WT_U64 wt_encode_morton3(const WT_U32* p, uint level) { return wt_morton3_encode(p[0], p[1], p[2]); }
inline WT_U64 wt_encode_morton5(const WT_U32* p, uint level) { return wt_morton5_encode(p[0], p[1], p[2], p[3], p[4]); }
inline WT_U64 wt_encode_hilbert2(const WT_U32* p, uint level) { return wt_hilbert2_encode(p[0], p[1], level); }
inline WT_U64 wt_encode_hilbert3(const WT_U32* p, uint level) { return wt_hilbert3_encode(p[0], p[1], p[2], level); }

inline void wt_decode_morton2(WT_U64 code, uint level, WT_U32* p) { wt_morton2_decode(code, p, p + 1); }
inline void wt_decode_morton3(WT_U64 code, uint level, WT_U32* p) { wt_morton3_decode(code, p, p + 1, p + 2); }
inline void wt_decode_morton5(WT_U64 code, uint level, WT_U32* p) {
  wt_morton5_decode(code, p, p + 1, p + 2, p + 3, p + 4);
}
inline void wt_decode_hilbert2(WT_U64 code, uint level, WT_U32* p) { wt_hilbert2_decode(code, level, p, p + 1); }
inline void wt_decode_hilbert3(WT_U64 code, uint level, WT_U32* p) { wt_hilbert3_decode(code, level, p, p + 1, p + 2); }

#if WT_KEY_BITS == 32
#define WT_KEY uint
#define WT_KEYS WT_U32
inline WT_U32 wt_key_morton2(const WT_U32* p, uint level) { return wt_morton2_encode32(p[0], p[1]); }
inline WT_U32 wt_key_morton3(const WT_U32* p, uint level) { return wt_morton3_encode32(p[0], p[1], p[2]); }
inline WT_U32 wt_key_morton5(const WT_U32* p, uint level) { return WT_TO_U32(wt_encode_morton5(p, level)); }
inline WT_U32 wt_key_hilbert2(const WT_U32* p, uint level) { return wt_hilbert2_encode32(p[0], p[1], level); }
inline WT_U32 wt_key_hilbert3(const WT_U32* p, uint level) { return wt_hilbert3_encode32(p[0], p[1], p[2], level); }
#else
#define WT_KEY ulong
#define WT_KEYS WT_U64
#endif

#if WT_LANES == 16
// The first `lanes` elements, 1 to 16; the rest is not touched, and 0 where it is loaded.
inline WT_U32 wt_load_words(const global uint* from, uint lanes) {
  if (lanes == 16) return vload16(0, from);
  uint words[16];
  for (uint i = 0; i < 16; ++i) words[i] = i < lanes ? from[i] : 0;
  return vload16(0, words);
}

inline WT_U64 wt_load_codes(const global ulong* from, uint lanes) {
  if (lanes == 16) return vload16(0, from);
  ulong codes[16];
  for (uint i = 0; i < 16; ++i) codes[i] = i < lanes ? from[i] : 0;
  return vload16(0, codes);
}

inline WT_F32 wt_load_floats(const global float* from, size_t stride, uint lanes) {
  float values[16];
  for (uint i = 0; i < 16; ++i) values[i] = i < lanes ? from[i * stride] : 0.0f;
  return vload16(0, values);
}

inline void wt_store_words(WT_U32 value, global uint* to, uint lanes) {
  if (lanes == 16) {
    vstore16(value, 0, to);
    return;
  }
  uint words[16];
  vstore16(value, 0, words);
  for (uint i = 0; i < lanes; ++i) to[i] = words[i];
}

inline void wt_store_keys(WT_KEYS value, global WT_KEY* to, uint lanes) {
  if (lanes == 16) {
    vstore16(value, 0, to);
    return;
  }
  WT_KEY keys[16];
  vstore16(value, 0, keys);
  for (uint i = 0; i < lanes; ++i) to[i] = keys[i];
}
#else
inline WT_U32 wt_load_words(const global uint* from, uint lanes) { return *from; }
inline WT_U64 wt_load_codes(const global ulong* from, uint lanes) { return *from; }
inline WT_F32 wt_load_floats(const global float* from, size_t stride, uint lanes) { return *from; }
inline void wt_store_words(WT_U32 value, global uint* to, uint lanes) { *to = value; }
inline void wt_store_keys(WT_KEYS value, global WT_KEY* to, uint lanes) { *to = value; }
#endif

kernel void point_keys(const global float* points, uint stride, uint count, wt_curve_box box, uint level,
                       global WT_KEY* keys) {
  const size_t k = get_global_id(0) * (size_t)WT_LANES;
  if (k >= count) return;
  const uint lanes = (uint)min(count - k, (size_t)WT_LANES);
  WT_U32 p[WT_DIMENSIONS];
  for (uint d = 0; d < WT_DIMENSIONS; ++d) {
    const WT_F32 component = wt_load_floats(points + k * stride + d, stride, lanes);
    p[d] = wt_box_cell(component, box.lower[d], box.scale[d], box.cells, box.last);
  }
  wt_store_keys(WT_ENCODE(p, level), keys + k, lanes);
}

#if WT_KEY_BITS == 64
kernel void encode(const global uint* points, uint stride, uint count, uint level, global ulong* codes) {
  const size_t k = get_global_id(0) * (size_t)WT_LANES;
  if (k >= count) return;
  const uint lanes = (uint)min(count - k, (size_t)WT_LANES);
  WT_U32 p[WT_DIMENSIONS];
  for (size_t d = 0; d < WT_DIMENSIONS; ++d) p[d] = wt_load_words(points + d * stride + k, lanes);
  wt_store_keys(WT_ENCODE(p, level), codes + k, lanes);
}

kernel void decode(const global ulong* codes, uint count, uint level, global uint* points, uint stride) {
  const size_t k = get_global_id(0) * (size_t)WT_LANES;
  if (k >= count) return;
  const uint lanes = (uint)min(count - k, (size_t)WT_LANES);
  WT_U32 p[WT_DIMENSIONS];
  WT_DECODE(wt_load_codes(codes + k, lanes), level, p);
  for (size_t d = 0; d < WT_DIMENSIONS; ++d) wt_store_words(p[d], points + d * stride + k, lanes);
}
#endif
