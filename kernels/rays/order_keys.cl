// SPDX-License-Identifier: Apache-2.0
// order_keys: the sort key of every ray, from its launch index before rays exist, or from the queue before any depth.
// WT_LAUNCH_KEY and WT_QUEUE_KEY name the keys below, WT_PLACES and WT_BY_TABLE the map of launch_keys (see
// generate_rays). Keys are padded, so the last item may write past the count.
#ifdef WT_CPU
#define WT_LANES 16
#endif
#include "lib/hit.clh"
#include "lib/launch_ray.clh"
#include "wavetracer/device/curves.h"
#pragma OPENCL FP_CONTRACT OFF

// Z curve: the Morton code of the direction, 10 bits for each component.
inline WT_U32 wt_key_morton(wt_direction o, wt_direction d, uint bins) {
  (void)o, (void)bins;
  return wt_morton3_encode32(wt_cube_cell(d.x, 1024u), wt_cube_cell(d.y, 1024u), wt_cube_cell(d.z, 1024u));
}

// The thesis' histogram: bins^3 cubes around the sphere of directions, visited along a curve. A stable sort by this key
// leaves the rays of a bin in their order, as its lists do.
inline WT_U32 wt_key_morton_bins(wt_direction o, wt_direction d, uint bins) {
  (void)o;
  return wt_morton3_encode32(wt_cube_cell(d.x, bins), wt_cube_cell(d.y, bins), wt_cube_cell(d.z, bins));
}

inline WT_U32 wt_key_hilbert_bins(wt_direction o, wt_direction d, uint bins) {
  (void)o;
  const uint level = bins == 1u ? 0u : 32u - clz(bins - 1u);
  return wt_hilbert3_encode32(wt_cube_cell(d.x, bins), wt_cube_cell(d.y, bins), wt_cube_cell(d.z, bins), level);
}

// Orders by direction first (4,096 cells along a Hilbert curve on the octahedron), then by origin (16^3 cells of the
// scene); o is scaled to [-1, 1].
inline WT_U32 wt_key_direction_origin(wt_direction o, wt_direction d, uint bins) {
  (void)bins;
  WT_U32 x, y;
  wt_octahedron_encode(d, 6u, &x, &y);
  return (wt_hilbert2_encode32(x, y, 6u) << 12) |
         wt_morton3_encode32(wt_cube_cell(o.x, 16u), wt_cube_cell(o.y, 16u), wt_cube_cell(o.z, 16u));
}

// A key for rays that all have one origin: 65,536 cells of directions. Finer cells would cost the sort a third pass,
// which does not pay even with tens of millions of rays.
inline WT_U32 wt_key_direction(wt_direction o, wt_direction d, uint bins) {
  (void)o, (void)bins;
  WT_U32 x, y;
  wt_octahedron_encode(d, 8u, &x, &y);
  return wt_hilbert2_encode32(x, y, 8u);
}

#ifdef WT_CPU
#define WT_RAYS_PER_ITEM 16
inline ulong16 launch_index(ulong index) {
  return index + (ulong16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
inline float16 load(const global float* plane) { return vload16(0, plane); }
inline void store(uint16 key, global uint* keys) { vstore16(key, 0, keys); }
#else
#define WT_RAYS_PER_ITEM 1
inline ulong launch_index(ulong index) { return index; }
inline float load(const global float* plane) { return plane[0]; }
inline void store(uint key, global uint* keys) { keys[0] = key; }
#endif

kernel void launch_keys(global uint* keys, uint count, ulong first_index, wt_map_arguments map,
                        const global float* heights, uint table, uint window, uint bins) {
  const uint k = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (k >= count) return;
  wt_direction o;
  o.x = o.y = o.z = 0.0f;
  const wt_direction d = wt_launch_ray(launch_index(first_index + k), map, heights, (WT_U32)(table), window, 0u).along;
  store(WT_LAUNCH_KEY(o, d, bins), keys + k);
}

// to_unit: scales coordinates to [-1, 1].
kernel void queue_keys(const global float* rays, uint capacity, uint count, float to_unit, global uint* keys,
                       uint bins) {
  const uint k = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (k >= count) return;
  const global float* r = rays + k;
  const size_t plane = capacity;
  wt_direction o, d;
  o.x = load(r) * to_unit;
  o.y = load(r + plane) * to_unit;
  o.z = load(r + 2 * plane) * to_unit;
  d.x = load(r + 3 * plane);
  d.y = load(r + 4 * plane);
  d.z = load(r + 5 * plane);
  store(WT_QUEUE_KEY(o, d, bins), keys + k);
}
