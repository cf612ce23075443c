// SPDX-License-Identifier: Apache-2.0
// trace: the nearest hit of every ray of a queue, through a BVH8, ray after ray; the form for CPUs and unordered rays.
// It also counts the hits of every block of WT_BLOCK rays (for compaction). A work-item takes one block, found by
// wt_launch_index. With WT_INSTANCES, `moving` is traced too.
#include "lib/bvh8.clh"
#include "lib/launch.clh"
#include "lib/moving.clh"
#pragma OPENCL FP_CONTRACT OFF

// A work-item takes one block and its rays in turn.
kernel void trace(const global wt_bvh8_node* nodes, const global wt_triangle_block* blocks, const global float4* moving,
                  float extent_m, const global float* rays, uint capacity, uint ray_count, global float* hits,
                  global uint* block_hits) {
  const uint block = wt_launch_index();
  if (block >= (ray_count + WT_BLOCK - 1) / WT_BLOCK) return;
  const uint first = block * WT_BLOCK, end = min(first + WT_BLOCK, ray_count);
  uint count = 0;
  for (uint i = first; i < end; ++i) {
    const float3 o = wt_load_float3(rays, capacity, WT_RAY_ORIGIN, i),
                 d = wt_load_float3(rays, capacity, WT_RAY_DIRECTION, i);
    const uint source = wt_load_word(rays, capacity, WT_RAY_SURFACE, i);
    wt_hit hit = wt_nearest_bvh8(nodes, blocks, extent_m, o, d, 0.0f, WT_NONE, INFINITY, source);
#ifdef WT_INSTANCES
    wt_visit_moving(moving, extent_m, o, d, 0.0f, WT_NONE, source, wt_own_instance(source), WT_NONE, 0, &hit);
#endif
    wt_store_hit(hits, capacity, i, hit);
    count += hit.surface != WT_NONE;
  }
  block_hits[block] = count;
}
