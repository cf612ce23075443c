// SPDX-License-Identifier: Apache-2.0
// trace_rays: hits of packed rays with the triangles of a tree: the nearest ones, or with WT_ANY_HIT whether there is
// any. At equal distances the lower primitive counts, as in trace. corners: nine floats for each triangle. A work-item
// takes WT_RAYS_PER_ITEM rays in turn.
#include "lib/tree.clh"
#include "wavetracer/device/packed_rays.h"
#pragma OPENCL FP_CONTRACT OFF

// The weights of the second and third corner at the point where a ray meets a triangle, by the edge functions of
// lib/triangle.clh.
inline float2 wt_weights(const global float* corners, uint primitive, float3 o, float3 d) {
  const global float *a = corners + 9 * (size_t)primitive, *b = a + 3, *c = b + 3;
  const wt_shear s = wt_make_shear(o.x, o.y, o.z, d.x, d.y, d.z);
  const int z = s.axis, x = z == 2 ? 0 : z + 1, y = x == 2 ? 0 : x + 1;
  const float az = a[z] - s.oz, bz = b[z] - s.oz, cz = c[z] - s.oz;
  const float ax = fma(-s.sx, az, a[x] - s.ox), ay = fma(-s.sy, az, a[y] - s.oy);
  const float bx = fma(-s.sx, bz, b[x] - s.ox), by = fma(-s.sy, bz, b[y] - s.oy);
  const float cx = fma(-s.sx, cz, c[x] - s.ox), cy = fma(-s.sy, cz, c[y] - s.oy);
  const float u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
  const float det = u + v + w;
  return det == 0.0f ? (float2)(0.0f) : (float2)(v / det, w / det);
}

inline wt_hit wt_hit_of(const global WT_NODE* nodes, const global WT_LEAF* triangles, uint triangle_slots,
                        float extent_m, const global wt_packed_ray* ray, float3* o, float3* d) {
  *o = vload3(0, ray->origin);
  *d = vload3(0, ray->direction);
  return WT_NEAREST_STATIC(*o, *d, ray->t_min, WT_NONE, ray->t_max, WT_NONE);
}

#if WT_ANY_HIT
// met[i] becomes 1 where ray i meets a triangle, else 0.
kernel void any_hits(const global WT_NODE* nodes, const global WT_LEAF* triangles, uint triangle_slots, float extent_m,
                     const global wt_packed_ray* rays, uint count, global uint* met) {
  const size_t first = get_global_id(0) * (size_t)WT_RAYS_PER_ITEM, end = min(first + WT_RAYS_PER_ITEM, (size_t)count);
  for (size_t i = first; i < end; ++i) {
    float3 o, d;
    met[i] = wt_hit_of(nodes, triangles, triangle_slots, extent_m, rays + i, &o, &d).primitive != WT_NONE;
  }
}
#else
kernel void nearest_hits(const global WT_NODE* nodes, const global WT_LEAF* triangles, uint triangle_slots,
                         float extent_m, const global float* corners, const global wt_packed_ray* rays, uint count,
                         global wt_packed_hit* hits) {
  const size_t first = get_global_id(0) * (size_t)WT_RAYS_PER_ITEM, end = min(first + WT_RAYS_PER_ITEM, (size_t)count);
  for (size_t i = first; i < end; ++i) {
    float3 o, d;
    const wt_hit hit = wt_hit_of(nodes, triangles, triangle_slots, extent_m, rays + i, &o, &d);
    const int missed = hit.primitive == WT_NONE;
    const float2 weights = missed ? (float2)(0.0f) : wt_weights(corners, hit.primitive, o, d);
    hits[i].t = missed ? INFINITY : hit.t;
    hits[i].primitive = hit.primitive;
    hits[i].u = weights.x;
    hits[i].v = weights.y;
  }
}
#endif
