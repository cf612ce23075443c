// SPDX-License-Identifier: Apache-2.0
// trace: the nearest hit of every ray of a queue, through a BVH2, one ray per work-item; the form for GPUs. It also
// counts the hits of every block of WT_BLOCK rays (for compaction) if a work-group is a block (WT_COUNT_BLOCKS). Rays
// are found by wt_launch_index. With WT_INSTANCES, `moving` is traced too.
#include "lib/bvh2.clh"
#include "lib/launch.clh"
#include "lib/moving.clh"
#pragma OPENCL FP_CONTRACT OFF

inline bool trace_ray(const global wt_centred_node* nodes, const global wt_bvh2_triangle* triangles,
                      uint triangle_slots, const global float4* moving, float extent_m, const global float* rays,
                      uint capacity, uint i, global float* hits) {
  const float3 o = wt_load_float3(rays, capacity, WT_RAY_ORIGIN, i),
               d = wt_load_float3(rays, capacity, WT_RAY_DIRECTION, i);
  const uint source = wt_load_word(rays, capacity, WT_RAY_SURFACE, i);
  wt_hit hit = wt_nearest_bvh2(nodes, triangles, triangle_slots, o, d, 0.0f, WT_NONE, INFINITY, source);
#ifdef WT_INSTANCES
  wt_visit_moving(moving, extent_m, o, d, 0.0f, WT_NONE, source, wt_own_instance(source), WT_NONE, 0, &hit);
#endif
  wt_store_hit(hits, capacity, i, hit);
  return hit.surface != WT_NONE;
}

#ifdef WT_COUNT_BLOCKS
// One ray per work-item, one block per work-group.
__attribute__((reqd_work_group_size(WT_BLOCK, 1, 1))) kernel void trace(
    const global wt_centred_node* nodes, const global wt_bvh2_triangle* triangles, uint triangle_slots,
    const global float4* moving, float extent_m, const global float* rays, uint capacity, uint ray_count,
    global float* hits, global uint* block_hits) {
  const uint i = get_global_id(0);
  local uint count;
  if (get_local_id(0) == 0) count = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (i < ray_count && trace_ray(nodes, triangles, triangle_slots, moving, extent_m, rays, capacity, i, hits))
    atomic_inc(&count);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) == 0) block_hits[get_group_id(0)] = count;
}
#else
// One ray per work-item, in a launch of any shape; a pass of its own counts blocks (compact).
kernel void trace(const global wt_centred_node* nodes, const global wt_bvh2_triangle* triangles, uint triangle_slots,
                  const global float4* moving, float extent_m, const global float* rays, uint capacity, uint ray_count,
                  global float* hits, global uint* block_hits) {
  const uint i = wt_launch_index();
  if (i < ray_count) trace_ray(nodes, triangles, triangle_slots, moving, extent_m, rays, capacity, i, hits);
}
#endif
