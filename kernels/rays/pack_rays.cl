// SPDX-License-Identifier: Apache-2.0
// pack_rays: rays and hits from records to planes and back (wavetracer/device/packed_rays.h, records.h), for the passes
// that take planes. A labelled queue has WT_RAY_LABELLED_PLANES; other queues have WT_RAY_PLANES.
#include "lib/hit.clh"
#include "wavetracer/device/packed_rays.h"

// left: the triangle that each ray leaves, which is its surface, too; null: none, as at a transmitter. regions: the
// region of a ray cache that each ray belongs to; null: 0.
kernel void rays_to_planes(const global wt_packed_ray* packed, const global uint* left, const global uint* regions,
                           uint count, global float* rays, uint capacity, uint labelled) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const uint from = left ? left[i] : WT_NONE, region = regions ? regions[i] : 0u;
  wt_store_float3(rays, capacity, WT_RAY_ORIGIN, i, vload3(0, packed[i].origin));
  wt_store_float3(rays, capacity, WT_RAY_DIRECTION, i, vload3(0, packed[i].direction));
  wt_store_word(rays, capacity, WT_RAY_NODE, i, wt_with_quarter(WT_ROOT | region, i));
  wt_store_word(rays, capacity, WT_RAY_SURFACE, i, from);
  if (!labelled) return;
  wt_store_word(rays, capacity, WT_RAY_SAMPLE, i, i);
  wt_store_word(rays, capacity, WT_RAY_LEFT, i, from);
  wt_store_word(rays, capacity, WT_RAY_REGION, i, region);
  wt_store_word(rays, capacity, WT_RAY_ENTRY, i, WT_NONE);
}

kernel void planes_to_rays(const global float* rays, uint capacity, uint count, global wt_packed_ray* packed) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  wt_packed_ray ray;
  vstore3(wt_load_float3(rays, capacity, WT_RAY_ORIGIN, i), 0, ray.origin);
  vstore3(wt_load_float3(rays, capacity, WT_RAY_DIRECTION, i), 0, ray.direction);
  ray.t_min = 0.0f;
  ray.t_max = INFINITY;
  packed[i] = ray;
}

// The surface of a hit is its triangle.
kernel void hits_to_planes(const global wt_packed_hit* packed, uint count, global float* hits, uint capacity) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const uint primitive = packed[i].primitive;
  hits[wt_place(capacity, WT_HIT_T, i)] = packed[i].t;
  wt_store_word(hits, capacity, WT_HIT_PRIMITIVE, i, primitive);
  wt_store_word(hits, capacity, WT_HIT_SURFACE, i, primitive);
}

// Planes have no weights of corners: u and v become 0. Members are written one by one: PoCL 3.1 takes 1.1 s instead of
// 9 ms where a record is made first and written as a whole (bench_kernels pack_rays, 2^22 hits, two busy cores of an
// AMD EPYC, 2026-11-27).
kernel void planes_to_hits(const global float* hits, uint capacity, uint count, global wt_packed_hit* packed) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const uint primitive = wt_load_word(hits, capacity, WT_HIT_PRIMITIVE, i);
  packed[i].t = primitive == WT_NONE ? INFINITY : hits[wt_place(capacity, WT_HIT_T, i)];
  packed[i].primitive = primitive;
  packed[i].u = packed[i].v = 0.0f;
}
