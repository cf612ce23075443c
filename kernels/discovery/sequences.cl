// SPDX-License-Identifier: Apache-2.0
// sequences: the trie as a list (collect), its neighbours (commute), and a trie filled from another one, larger or
// without old sequences (regrow, follow). A node is its slot, so a parent must be in the new table before its children:
// regrow runs once for each depth.
// With WT_AGES, ages[slot] is twice the last frame in which the sequence was met, by a ray, as a neighbour or by a
// path, plus one if by a ray; a node is never older than its children. `now` is the age of rays in this frame.
// quarters: see lib/trie.clh. A sequence that is entered for another one gets the quarters of that one.
#include "lib/count.clh"
#include "lib/enter.clh"

// Empties the set of sequences and sets all counters to zero. A work-item takes WT_SLOTS_PER_ITEM slots.
kernel void clear(global ulong* table, global uint* quarters, uint slots, global wt_counters* counters) {
  const uint item = get_global_id(0), first = item * WT_SLOTS_PER_ITEM, end = min(first + WT_SLOTS_PER_ITEM, slots);
  for (uint k = item; k < sizeof(wt_counters) / sizeof(uint); k += get_global_size(0)) ((global uint*)counters)[k] = 0;
  for (uint slot = first; slot < end; ++slot) {
    table[slot] = WT_EMPTY;
    quarters[slot] = 0;
  }
}

// Appends the id of every used slot to nodes, in no particular order; counters->nodes is their number. A work-item
// takes WT_SLOTS_PER_ITEM slots.
kernel void collect(const global ulong* table, uint slots, global uint* nodes, uint capacity,
                    global wt_counters* counters) {
#if WT_SLOTS_PER_ITEM == 1
  const uint slot = get_global_id(0);
  if (slot >= slots || table[slot] == WT_EMPTY) return;
  const uint i = atomic_inc(&counters->nodes);
  if (i < capacity) nodes[i] = slot;
#else
  const uint first = get_global_id(0) * WT_SLOTS_PER_ITEM, end = min(first + WT_SLOTS_PER_ITEM, slots);
  uint used = 0;
  for (uint slot = first; slot < end; ++slot) used += table[slot] != WT_EMPTY ? 1u : 0u;
  if (used == 0) return;
  uint i = atomic_add(&counters->nodes, used);
  for (uint slot = first; slot < end; ++slot) {
    if (table[slot] == WT_EMPTY) continue;
    if (i < capacity) nodes[i] = slot;
    ++i;
  }
#endif
}

// Surfaces count as perpendicular below this cosine: a vain attempt only costs a candidate.
#define WT_PERPENDICULAR 0.02f

// Mirrors in perpendicular planes commute: if a ray met a wall and then the ground, the same image also serves the
// ground and then the wall, and the receiver's position decides which of the two is a path. Rays find one of them and
// may miss the other (nearly all missed paths of street scenes are of this kind), so both are entered: for every listed
// node, every exchange of two neighbouring perpendicular surfaces. Geometry decides later, as always. counters->nodes
// nodes are listed, at most node_count; new ones are listed after them, as far as there is room. `lanes` work-items
// take the pairs of a node in turn.
kernel void commute(global ulong* table, uint mask, global uint* nodes, uint node_count, uint capacity,
                    const global wt_surface* surfaces, global uint* quarters, global wt_counters* counters,
                    global uint* ages, uint now, uint lanes) {
  const uint i = get_global_id(0) / lanes;
  if (i >= min(node_count, counters->nodes) || (nodes[i] & WT_ROOT)) return;
#ifdef WT_AGES
  if (wt_load_relaxed_u32(ages + nodes[i]) != now)
    return;  // no ray met it in this frame, so its neighbours are as old as it is
#else
  wt_chains_prefetch(table, nodes, i, min(node_count, counters->nodes));
#endif
  uint chain[WT_MAX_DEPTH], parents[WT_MAX_DEPTH];  // from the last surface back, with the node that each was added to
  uint depth = 0;
  for (uint n = nodes[i]; !(n & WT_ROOT) && depth < WT_MAX_DEPTH; n = parents[depth - 1]) {
    const ulong key = wt_load_relaxed_u64(table + n);  // others are inserting
    chain[depth] = wt_trie_surface(key);
    parents[depth++] = wt_trie_parent(key);
  }
  const uint found = wt_load_relaxed_u32(quarters + nodes[i]) & WT_ALL_QUARTERS;
  for (uint k = get_global_id(0) % lanes; k + 1 < depth; k += lanes) {
    const global float* a = surfaces[chain[k]].normal;
    const global float* b = surfaces[chain[k + 1]].normal;
    if (!(fabs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) <= WT_PERPENDICULAR)) continue;  // also of absent instances
    // A surface never follows itself: the image of its image is the point itself, and rounding would see a path through
    // it.
    if ((k + 2 < depth && chain[k + 2] == chain[k]) || (k > 0 && chain[k - 1] == chain[k + 1])) continue;
    uint node = wt_enter(table, mask, parents[k + 1], chain[k], nodes, capacity, counters, quarters, found, ages, now);
    node = wt_enter(table, mask, node, chain[k + 1], nodes, capacity, counters, quarters, found, ages, now);
    for (uint j = k; j-- > 0;)
      node = wt_enter(table, mask, node, chain[j], nodes, capacity, counters, quarters, found, ages, now);
    if (node == WT_NONE) atomic_or(&counters->trie_overflow, 1u);
  }
}

// Inserts the nodes of one depth of the old table into the new one, except those older than `oldest`, and stores their
// new slots.
kernel void regrow(const global ulong* old_table, uint old_slots, uint depth, global uint* moved, global ulong* table,
                   uint mask, const global uint* old_quarters, global uint* quarters, global wt_counters* counters,
                   const global uint* old_ages, global uint* ages, uint oldest) {
  const uint slot = get_global_id(0);
  if (slot >= old_slots || old_table[slot] == WT_EMPTY) return;
  const uint parent = wt_trie_parent(old_table[slot]);
  uint level = 1;
  for (uint p = parent; !(p & WT_ROOT); p = wt_trie_parent(old_table[p])) ++level;
  if (level != depth) return;
#ifdef WT_AGES
  if (old_ages[slot] < oldest) return;
#endif
  const uint node =
      wt_trie_insert(table, mask, parent & WT_ROOT ? parent : moved[parent], wt_trie_surface(old_table[slot]));
  moved[slot] = node;
  if (node == WT_NONE) atomic_or(&counters->trie_overflow, 1u);
  if (node != WT_NONE) quarters[node] = old_quarters[slot];
#ifdef WT_AGES
  if (node != WT_NONE) ages[node] = old_ages[slot];
#endif
}

// Gives the sequences of visible paths, and their prefixes, the age of the frame.
kernel void keep(const global ulong* table, const global wt_solved* solved, uint solved_count, uint solved_counter,
                 const global wt_counters* counters, global uint* ages, uint now) {
  const uint i = get_global_id(0);
  if (i >= wt_length(counters, solved_counter, solved_count) || solved[i].blocked) return;
  for (uint n = solved[i].node; !(n & WT_ROOT); n = wt_trie_parent(table[n])) atomic_max(ages + n, now - 1);
}

// Run after regrow: gives listed nodes their new ids.
kernel void follow(global uint* nodes, uint node_count, const global uint* moved) {
  const uint i = get_global_id(0);
  if (i < node_count && !(nodes[i] & WT_ROOT)) nodes[i] = moved[nodes[i]];
}
