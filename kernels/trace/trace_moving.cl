// SPDX-License-Identifier: Apache-2.0
// trace_moving: tests hits of the static scene against the instances: a hit of an instance that comes before a ray's
// hit replaces it. After trace of the static scene alone, the result is that of trace with all. A work-item takes
// WT_RAYS_PER_ITEM rays.
#include "lib/moving.clh"
#pragma OPENCL FP_CONTRACT OFF

kernel void trace_moving(const global float4* moving, float extent_m, const global float* rays, uint capacity,
                         uint ray_count, global float* hits) {
  const uint first = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (first >= ray_count) return;
  const uint end = first + min((uint)WT_RAYS_PER_ITEM, ray_count - first);
  for (uint i = first; i < end; ++i) {
    const float3 o = wt_load_float3(rays, capacity, WT_RAY_ORIGIN, i),
                 d = wt_load_float3(rays, capacity, WT_RAY_DIRECTION, i);
    const uint source = wt_load_word(rays, capacity, WT_RAY_SURFACE, i);
    const uint found = wt_load_word(hits, capacity, WT_HIT_PRIMITIVE, i);
    wt_hit hit = {found == WT_NONE ? INFINITY : hits[i], found, wt_load_word(hits, capacity, WT_HIT_SURFACE, i)};
    wt_visit_moving(moving, extent_m, o, d, 0.0f, WT_NONE, source, wt_own_instance(source), WT_NONE, 0, &hit);
    if (hit.primitive == found) continue;
    wt_store_hit(hits, capacity, i, hit);
  }
}
