// sequences: the trie as a list (collect), and a larger trie filled from a smaller one (regrow).
// A node is its slot, so a parent must be in the new table before its children: regrow runs once a depth.
#include "lib/trie.clh"

// Appends the id of every used slot to nodes, in no particular order; counters->nodes is their number.
kernel void collect(const global ulong* table, uint slots, global uint* nodes, uint capacity, global wt_counters* counters) {
  const uint slot = get_global_id(0);
  if (slot >= slots || table[slot] == WT_EMPTY) return;
  const uint i = atomic_inc(&counters->nodes);
  if (i < capacity) nodes[i] = slot;
}

// Inserts the nodes of one depth of the old table into the new one and notes where they went.
kernel void regrow(const global ulong* old_table, uint old_slots, uint depth, global uint* moved, global ulong* table, uint mask,
                   global wt_counters* counters) {
  const uint slot = get_global_id(0);
  if (slot >= old_slots || old_table[slot] == WT_EMPTY) return;
  const uint parent = wt_trie_parent(old_table[slot]);
  uint level = 1;
  for (uint p = parent; !(p & WT_ROOT); p = wt_trie_parent(old_table[p])) ++level;
  if (level != depth) return;
  const uint node = wt_trie_insert(table, mask, parent & WT_ROOT ? parent : moved[parent], wt_trie_surface(old_table[slot]));
  moved[slot] = node;
  if (node == WT_NONE) counters->trie_overflow = 1;
}
