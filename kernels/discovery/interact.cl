// SPDX-License-Identifier: Apache-2.0
// interact: every ray that hit something enters its prefix into the trie and is reflected; the reflected rays are
// compacted, in order. Consumes rays, hits and the scanned hits of the blocks; produces the next queue. last: no ray is
// reflected. With WT_THROUGH every such ray also goes on straight, in the same place of the queue `through`.
// quarters[node] gets the bits of the rays that reach the node.
// With WT_AGES, ages[node] becomes `now` for every node that a ray reaches.
// With WT_SAMPLES, ends[sample] becomes the node. With WT_LABELS, queues have all planes of records.h.
#include "lib/block_rank.clh"
#include "lib/mirror.clh"
#include "lib/trie.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// Stores the end of a sample so far: the sequence that its ray has met.
inline void note_end(const global float* rays, uint capacity, uint i, uint node, global uint* ends) {
#ifdef WT_SAMPLES
  ends[wt_load_word(rays, capacity, WT_RAY_SAMPLE, i)] = node;
#endif
}

// Stores ray i as ray j of a queue; it goes on from o along d. word: its node and quarter.
inline void store_ray(const global float* rays, const global float* hits, uint capacity, uint i, uint surface,
                      uint word, float3 o, float3 d, global float* queue, uint j) {
  wt_store_float3(queue, capacity, WT_RAY_ORIGIN, j, o);
  wt_store_float3(queue, capacity, WT_RAY_DIRECTION, j, d);
  wt_store_word(queue, capacity, WT_RAY_NODE, j, word);
  wt_store_word(queue, capacity, WT_RAY_SURFACE, j, surface);
#if defined(WT_SAMPLES) || defined(WT_LABELS)
  wt_store_word(queue, capacity, WT_RAY_SAMPLE, j, wt_load_word(rays, capacity, WT_RAY_SAMPLE, i));
#endif
#ifdef WT_LABELS
  wt_store_word(queue, capacity, WT_RAY_LEFT, j, wt_load_word(hits, capacity, WT_HIT_PRIMITIVE, i));
  wt_store_word(queue, capacity, WT_RAY_REGION, j, wt_load_word(rays, capacity, WT_RAY_REGION, i));
  wt_store_word(queue, capacity, WT_RAY_ENTRY, j, wt_load_word(rays, capacity, WT_RAY_ENTRY, i));
#endif
}

// The reflected ray has the node of its hit; the transmitted ray has not turned and keeps its node.
inline void store(const global wt_surface* surfaces, const global float* rays, const global float* hits, uint capacity,
                  uint i, uint surface, uint word, uint node, uint last, global float* next, global float* through,
                  uint j) {
  float3 o = wt_load_float3(rays, capacity, WT_RAY_ORIGIN, i), d = wt_load_float3(rays, capacity, WT_RAY_DIRECTION, i);
#ifdef WT_THROUGH
  store_ray(rays, hits, capacity, i, surface, word, wt_behind(surfaces + surface, hits[i], o, d), d, through, j);
  if (last) return;
#endif
  wt_mirror(surfaces + surface, hits[i], &o, &d);
  store_ray(rays, hits, capacity, i, surface, node | (word & WT_QUARTER_BITS), o, d, next, j);
}

// Does a ray that hit something go on?
inline bool goes_on(uint last) {
#ifdef WT_THROUGH
  return true;
#else
  return !last;
#endif
}

#ifdef WT_CPU
// A work-item takes WT_BLOCKS_PER_ITEM blocks and their rays in turn. Neighbours mostly share their prefix, so the last
// insertion is kept.
kernel void interact(const global float* rays, const global float* hits, const global uint* block_offsets,
                     const global wt_surface* surfaces, global ulong* table, global uint* quarters,
                     global wt_counters* counters, global float* next, global uint* ages, global uint* ends,
                     global float* through, wt_interact_arguments args) {
  const uint first_block = get_global_id(0) * WT_BLOCKS_PER_ITEM;
  const uint first = first_block * WT_BLOCK, end = min(first + WT_BLOCKS_PER_ITEM * WT_BLOCK, args.ray_count);
  if (first >= args.ray_count) return;
  uint j = block_offsets[first_block];
  uint last_parent = WT_NONE, last_surface = WT_NONE, last_node = WT_NONE, found = 0;
  for (uint i = first; i < end; ++i) {
    if (i + WT_AHEAD < end)
      wt_trie_prefetch(table, quarters, args.trie_mask,
                       wt_node_of(wt_load_word(rays, args.capacity, WT_RAY_NODE, i + WT_AHEAD)),
                       wt_load_word(hits, args.capacity, WT_HIT_SURFACE, i + WT_AHEAD));
    const uint surface = wt_load_word(hits, args.capacity, WT_HIT_SURFACE, i);
    if (surface == WT_NONE) continue;
    const uint word = wt_load_word(rays, args.capacity, WT_RAY_NODE, i), parent = wt_node_of(word);
    if (parent != last_parent || surface != last_surface) {
      wt_note_quarters(quarters, last_node, found);
      found = 0;
      last_node = wt_trie_insert(table, args.trie_mask, parent, surface);
      last_parent = parent;
      last_surface = surface;
      if (last_node == WT_NONE) atomic_or(&counters->trie_overflow, 1u);
#ifdef WT_AGES
      if (last_node != WT_NONE) ages[last_node] = args.now;
#endif
    }
    found |= wt_quarter_bit(word);
    note_end(rays, args.capacity, i, last_node, ends);
    if (goes_on(args.last))
      store(surfaces, rays, hits, args.capacity, i, surface, word, last_node, args.last, next, through, j);
    ++j;
  }
  wt_note_quarters(quarters, last_node, found);
}
#else
// One ray per work-item, one block per work-group.
__attribute__((reqd_work_group_size(WT_BLOCK, 1, 1))) kernel void interact(
    const global float* rays, const global float* hits, const global uint* block_offsets,
    const global wt_surface* surfaces, global ulong* table, global uint* quarters, global wt_counters* counters,
    global float* next, global uint* ages, global uint* ends, global float* through, wt_interact_arguments args) {
  local uint alive[WT_BLOCK_MASKS];
  const uint i = get_global_id(0);
  const uint surface = i < args.ray_count ? wt_load_word(hits, args.capacity, WT_HIT_SURFACE, i) : WT_NONE;
  wt_mark_block(alive, surface != WT_NONE);
  if (surface == WT_NONE) return;
  const uint word = wt_load_word(rays, args.capacity, WT_RAY_NODE, i);
  const uint node = wt_trie_insert(table, args.trie_mask, wt_node_of(word), surface);
  if (node == WT_NONE) atomic_or(&counters->trie_overflow, 1u);
  wt_note_quarters(quarters, node, wt_quarter_bit(word));
#ifdef WT_AGES
  if (node != WT_NONE) ages[node] = args.now;
#endif
  note_end(rays, args.capacity, i, node, ends);
  if (!goes_on(args.last)) return;
  const uint j = block_offsets[get_group_id(0)] + wt_block_rank(alive);
  store(surfaces, rays, hits, args.capacity, i, surface, word, node, args.last, next, through, j);
}
#endif
