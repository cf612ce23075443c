// SPDX-License-Identifier: Apache-2.0
// trace: the nearest hit of every ray of a queue, through a BVH2, 16 rays at once; the form for CPUs and ordered rays.
// It also counts the hits of every block of 16 rays (for compaction). A work-item takes one block, found by
// wt_launch_index. With WT_INSTANCES, `moving` is traced too.
#include "lib/bvh8.clh"
#include "lib/launch.clh"
#include "lib/moving16.clh"
#include "lib/packet16.clh"
#pragma OPENCL FP_CONTRACT OFF

// If fewer lanes than this agree in signs and dominant axis, they are traced one by one.
#define WT_PACKET_MIN_LANES 4

// One block of 16 rays per work-item: lanes that agree in the signs and the dominant axis of their directions go as a
// packet. Queues are padded so that reading 16 rays never leaves a plane.
kernel void trace(const global wt_bvh2_node* nodes, const global wt_bvh2_triangle* triangles, uint triangle_slots,
                  const global wt_bvh8_node* nodes8, const global wt_triangle_block* blocks,
                  const global float4* moving, float extent_m, const global float* rays, uint capacity, uint ray_count,
                  global float* hits, global uint* block_hits) {
  const uint block = wt_launch_index();
  if (block >= (ray_count + 15) / 16) return;
  const uint first = block * 16;
  const uint end = min(first + 16, ray_count);
  const uint16 lane = (uint16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const int16 in_range = lane < end - first;
  const float16 ox = wt_load16(rays, capacity, WT_RAY_ORIGIN, first);
  const float16 oy = wt_load16(rays, capacity, WT_RAY_ORIGIN + 1, first);
  const float16 oz = wt_load16(rays, capacity, WT_RAY_ORIGIN + 2, first);
  const float16 dx = wt_load16(rays, capacity, WT_RAY_DIRECTION, first);
  const float16 dy = wt_load16(rays, capacity, WT_RAY_DIRECTION + 1, first);
  const float16 dz = wt_load16(rays, capacity, WT_RAY_DIRECTION + 2, first);
  const uint16 source = as_uint16(wt_load16(rays, capacity, WT_RAY_SURFACE, first));

  const float16 ax = fabs(dx), ay = fabs(dy), az = fabs(dz);
  // This is wt_dominant_axis, lane by lane.
  const int16 axis = select(select((int16)2, (int16)1, ay > az), select((int16)2, (int16)0, ax > az), ax > ay);
  wt_packet p;
  p.ix = select(copysign((float16)1e18f, dx), 1.0f / dx, ax > 1e-18f);
  p.iy = select(copysign((float16)1e18f, dy), 1.0f / dy, ay > 1e-18f);
  p.iz = select(copysign((float16)1e18f, dz), 1.0f / dz, az > 1e-18f);
  // The class of a lane: the signs and the dominant axis of its direction.
  const int16 class =
      select((int16)-1, axis * 8 + ((p.ix < 0.0f) & 1) + ((p.iy < 0.0f) & 2) + ((p.iz < 0.0f) & 4), in_range);
  int classes[16];
  vstore16(class, 0, classes);
  const float16 delta = 2.5e-7f * (extent_m + wt_max16(fabs(ox), wt_max16(fabs(oy), fabs(oz))));
  p.nx = -ox * p.ix - delta * fabs(p.ix);
  p.ny = -oy * p.iy - delta * fabs(p.iy);
  p.nz = -oz * p.iz - delta * fabs(p.iz);
  p.fx = -ox * p.ix + delta * fabs(p.ix);
  p.fy = -oy * p.iy + delta * fabs(p.iy);
  p.fz = -oz * p.iz + delta * fabs(p.iz);
  p.source = source;

#ifdef WT_INSTANCES
  float origins[48], directions[48];  // as rows
  uint sources[16];
  vstore16(ox, 0, origins);
  vstore16(oy, 1, origins);
  vstore16(oz, 2, origins);
  vstore16(dx, 0, directions);
  vstore16(dy, 1, directions);
  vstore16(dz, 2, directions);
  vstore16(source, 0, sources);
#endif

  float16 t = INFINITY;
  uint16 primitive = WT_NONE, surface = WT_NONE;
  uint remaining = (1u << (end - first)) - 1;
  while (remaining) {
    const int first_lane = popcount((remaining & (~remaining + 1)) - 1u);
    const int c = classes[first_lane];
    const int16 active = class == c;
    uint mask = 0;
    for (int i = 0; i < 16; ++i) mask |= (uint)(classes[i] == c) << i;
    remaining &= ~mask;
    if (popcount(mask) < WT_PACKET_MIN_LANES) {
      for (uint m = mask; m; m &= m - 1) {
        const uint i = first + popcount((m & (~m + 1)) - 1u);
        const float3 ray_o = wt_load_float3(rays, capacity, WT_RAY_ORIGIN, i),
                     ray_d = wt_load_float3(rays, capacity, WT_RAY_DIRECTION, i);
        const uint ray_source = wt_load_word(rays, capacity, WT_RAY_SURFACE, i);
        wt_hit hit = wt_nearest_bvh8(nodes8, blocks, extent_m, ray_o, ray_d, 0.0f, WT_NONE, INFINITY, ray_source);
#ifdef WT_INSTANCES
        wt_visit_moving(moving, extent_m, ray_o, ray_d, 0.0f, WT_NONE, ray_source, wt_own_instance(ray_source), WT_NONE,
                        0, &hit);
#endif
        const int16 here = lane == i - first;
        t = select(t, (float16)hit.t, here);
        primitive = select(primitive, (uint16)hit.primitive, here);
        surface = select(surface, (uint16)hit.surface, here);
      }
      continue;
    }
    const int axis_last = c >> 3;
    p.ox = axis_last == 0 ? oy : axis_last == 1 ? oz : ox;
    p.oy = axis_last == 0 ? oz : axis_last == 1 ? ox : oy;
    p.oz = axis_last == 0 ? ox : axis_last == 1 ? oy : oz;
    p.sz = 1.0f / (axis_last == 0 ? dx : axis_last == 1 ? dy : dz);
    p.sx = (axis_last == 0 ? dy : axis_last == 1 ? dz : dx) * p.sz;
    p.sy = (axis_last == 0 ? dz : axis_last == 1 ? dx : dy) * p.sz;
    p.t = select((float16)-1.0f, (float16)INFINITY, active);
    p.primitive = WT_NONE;
    p.surface = WT_NONE;
    wt_nearest_packet16(nodes, triangles, triangle_slots, c & 1, (c >> 1) & 1, (c >> 2) & 1, axis_last, &p);
#ifdef WT_INSTANCES
    wt_visit_moving16(moving, extent_m, c & 1, (c >> 1) & 1, (c >> 2) & 1, origins, directions, sources, &p);
#endif
    t = select(t, p.t, active);
    primitive = select(primitive, p.primitive, active);
    surface = select(surface, p.surface, active);
  }
  wt_store16(hits, capacity, WT_HIT_T, first, t);
  wt_store16(hits, capacity, WT_HIT_PRIMITIVE, first, as_float16(primitive));
  wt_store16(hits, capacity, WT_HIT_SURFACE, first, as_float16(surface));
  int missed[16];
  vstore16(surface == WT_NONE, 0, missed);
  uint count = 0;
  for (uint i = 0; i < end - first; ++i) count += missed[i] == 0;
  block_hits[block] = count;
}
