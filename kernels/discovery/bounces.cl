// SPDX-License-Identifier: Apache-2.0
// bounces: follows every ray of a queue from its launch to its last hit, in one work-item: the nearest hit, its prefix
// into the trie, the reflection, and again. It replaces trace, scan and interact, without a queue, where nothing else
// happens between two depths. Consumes rays; counters->ended[n] gets the rays that ended after n hits.
// quarters, ages, ends: as in interact. With WT_INSTANCES, `moving` is traced too.
#include "lib/mirror.clh"
#include "lib/tree.clh"
#include "lib/trie.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// Returns the number of the ray's hits. word: its root and quarter; *node: that of the longest sequence that the ray
// has met.
inline uint bounce(const global WT_NODE* nodes, const global WT_LEAF* triangles, const global float4* moving, float3 o,
                   float3 d, uint source, uint word, const global wt_surface* surfaces, global ulong* table,
                   global uint* quarters, global wt_counters* counters, global uint* ages, wt_bounces_arguments args,
                   uint* node) {
  const uint triangle_slots = args.triangle_slots, quarter = wt_quarter_bit(word);
  const float extent_m = args.extent_m;
  *node = wt_node_of(word);
  for (uint hits = 0; hits < args.interactions; ++hits) {
    wt_hit hit = WT_NEAREST_STATIC(o, d, 0.0f, WT_NONE, INFINITY, source);
#ifdef WT_INSTANCES
    wt_visit_moving(moving, extent_m, o, d, 0.0f, WT_NONE, source, wt_own_instance(source), WT_NONE, 0, &hit);
#endif
    if (hit.surface == WT_NONE) return hits;
    *node = wt_trie_insert(table, args.trie_mask, *node, hit.surface);
    if (*node == WT_NONE) atomic_or(&counters->trie_overflow, 1u);
    wt_note_quarters(quarters, *node, quarter);
#ifdef WT_AGES
    if (*node != WT_NONE) ages[*node] = args.now;
#endif
    wt_mirror(surfaces + hit.surface, hit.t, &o, &d);
    source = hit.surface;
  }
  return args.interactions;
}

kernel void bounces(const global WT_NODE* nodes, const global WT_LEAF* triangles, const global float4* moving,
                    const global float* rays, const global wt_surface* surfaces, global ulong* table,
                    global uint* quarters, global wt_counters* counters, global uint* ages, global uint* ends,
                    wt_bounces_arguments args) {
  local uint ended[WT_MAX_DEPTH + 1];
  for (uint k = get_local_id(0); k <= args.interactions; k += get_local_size(0)) ended[k] = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint i = get_global_id(0);
  if (i < args.ray_count) {
    uint node;
    const uint hits = bounce(
        nodes, triangles, moving, wt_load_float3(rays, args.capacity, WT_RAY_ORIGIN, i),
        wt_load_float3(rays, args.capacity, WT_RAY_DIRECTION, i), wt_load_word(rays, args.capacity, WT_RAY_SURFACE, i),
        wt_load_word(rays, args.capacity, WT_RAY_NODE, i), surfaces, table, quarters, counters, ages, args, &node);
#ifdef WT_SAMPLES
    ends[wt_load_word(rays, args.capacity, WT_RAY_SAMPLE, i)] = node;
#endif
    atomic_inc(ended + hits);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint k = get_local_id(0); k <= args.interactions; k += get_local_size(0))
    if (ended[k]) atomic_add(counters->ended + k, ended[k]);
}
