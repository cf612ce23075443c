// SPDX-License-Identifier: Apache-2.0
// Keys and buckets of the thesis' tables as it prints them (A. Zhdanov, TU Munich, 2014, listings C.1 and C.3 and
// section 5.2.2), for host and device alike. They keep the faults that cache.h corrects.
#ifndef WAVETRACER_DEVICE_CACHE_THESIS_H
#define WAVETRACER_DEVICE_CACHE_THESIS_H
#include "wavetracer/device/types.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// separateBy4 of the thesis: it takes the lowest seven bits, which say nothing about where something is.
inline wt_uint wt_thesis_separate_by_4(wt_uint x) {
  x &= 0x0000007Fu;
  x = (x ^ (x << 16)) & 0x0070000Fu;
  x = (x ^ (x << 8)) & 0x40300C03u;
  x = (x ^ (x << 4)) & 0x42108421u;
  return x;
}

// The remainder of a signed 64-bit number by 2^32 - 5, with its sign, as on the device of the thesis.
inline wt_ulong wt_thesis_remainder(wt_ulong x) {
  const wt_ulong p = 0xFFFFFFFBul;
  return x >> 63 ? 0ul - (0ul - x) % p : x % p;
}

// calc_hash1 of the thesis. Signed products and sums wrap.
inline wt_uint wt_thesis_hash1(wt_uint primitive, wt_uint instance, wt_uint x, wt_uint y, wt_uint z) {
  const wt_uint numbers[5] = {primitive, instance, x, y, z};
  wt_ulong s = 0, zi = 1;
  for (int i = 0; i < 5; ++i) {
    const wt_uint product = numbers[i] * 0x5067D19Du;
    const wt_ulong sign = product >> 31 ? 0xFFFFFFFF80000000ul : 0ul;
    s = wt_thesis_remainder(s + zi * (sign | product >> 1));
    zi = wt_thesis_remainder(zi * 0x64B6055Aul);
  }
  return (wt_uint)wt_thesis_remainder(s + zi * 0xFFFFFFFAul);
}

// calc_hash2 and mortonCode5 of the thesis.
inline wt_uint wt_thesis_hash2(wt_uint primitive, wt_uint instance, wt_uint x, wt_uint y, wt_uint z) {
  return wt_thesis_separate_by_4(x) | wt_thesis_separate_by_4(y) << 1 | wt_thesis_separate_by_4(z) << 2 |
         wt_thesis_separate_by_4(instance) << 3 | wt_thesis_separate_by_4(primitive) << 4;
}

// Numbers of models (section 3.2.3): the environment is one model, whose id is -1 in 16 bits. Every surface of it has
// that number. An instance has its own number, from 1 on, because 0 is what a ray has at a transmitter.
#define WT_THESIS_ENVIRONMENT 0xFFFFu

// The instanceId of a key. instance: that of the surface that a ray left, WT_NONE for one of the static scene.
inline wt_uint wt_thesis_model(wt_uint instance) {
  return instance == 0xFFFFFFFFu ? WT_THESIS_ENVIRONMENT : (instance + 1u) & 0xFFFFu;
}

// setIndices of the thesis, with a hash_method. Cells are packed as by wt_cache_cells.
inline wt_uint wt_thesis_hash(wt_uint method, wt_ulong cells, wt_uint primitive, wt_uint instance) {
  const wt_uint x = (wt_uint)cells & 0x1FFFFFu, y = (wt_uint)(cells >> 21) & 0x1FFFFFu, z = (wt_uint)(cells >> 42);
  wt_uint hash = 0;
  if (method != 2) hash += wt_thesis_hash1(primitive, instance, x, y, z);
  if (method != 1) hash += wt_thesis_hash2(primitive, instance, x, y, z);
  return hash;
}

// getBucketIndex of listing C.3: no hash reaches the upper half of the table, or more than 2^24 places of it.
inline wt_uint wt_thesis_slot(wt_uint hash, wt_uint entries) {
  return (wt_uint)(((float)hash / 4294967295.0f) * (float)(entries - 1) / 2.0f);
}

// The same for the chained table and a signed hash: section 5.2.2 adds one before it halves.
inline wt_uint wt_thesis_bucket(wt_uint hash, wt_uint buckets) {
  const float part = (float)(wt_int)hash / 2147483647.0f + 1.0f;
  const float bucket = part * (float)(buckets - 1) / 2.0f;
  return bucket < (float)(buckets - 1) ? (wt_uint)bucket : buckets - 1;  // never beyond the end, if float rounds up
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
