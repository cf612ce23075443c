// SPDX-License-Identifier: Apache-2.0
// Kernels that only tests run: each uses kernels/lib/memory_order.clh in a way whose outcome a host can count.
// Assumes buffers cleared by the host; global sizes may exceed `count`.
#include "lib/memory_order.clh"

// places[i] gets the number of work-items that added before this one: all differ if the add is atomic.
kernel void take_places(global uint* counter, global uint* places, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  places[i] = wt_fetch_add_u32(counter, 1u);
}

// Inserts into a set of non-zero words with linear probing. `inserted` counts the words that were new, `winners[slot]`
// their claims.
kernel void insert_words(global const ulong* words, uint count, global ulong* slots, uint slot_mask,
                         global uint* inserted, global uint* winners, global uint* lost) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const ulong word = words[i];
  uint slot = (uint)((word * 0x9e3779b97f4a7c15ul) >> 40) & slot_mask;
  for (uint probe = 0; probe <= slot_mask; ++probe, slot = (slot + 1) & slot_mask) {
    ulong found = wt_load_relaxed_u64(slots + slot);
    if (found == 0) found = wt_compare_swap_relaxed_u64(slots + slot, 0ul, word);
    if (found == 0) {
      wt_fetch_add_u32(inserted, 1u);
      wt_fetch_add_u32(winners + slot, 1u);
      return;
    }
    if (found == word) return;
  }
  wt_fetch_add_u32(lost, 1u);
}

// slots[i % slot_count] keeps the lowest word, and first[...] the number of the work-item that came first.
kernel void keep_lowest(global const uint* words, uint count, global uint* slots, uint slot_count, global uint* first,
                        global uint* firsts) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  wt_fetch_min_u32(slots + i % slot_count, words[i]);
  if (wt_compare_swap_relaxed_u32(first + i % slot_count, 0xFFFFFFFFu, i) == 0xFFFFFFFFu) wt_fetch_add_u32(firsts, 1u);
}

// Returns the pair that this work-item shares with one of the work-group `distance` (a power of two) away. Which
// distance makes two items meet depends on how a device spreads its groups over cores, and on whether it runs a group's
// items in turn.
inline uint pair_of_item(uint distance) {
  const uint group = (uint)get_group_id(0);
  return (group / (2 * distance) * distance + group % distance) * (uint)get_local_size(0) + (uint)get_local_id(0);
}

// One group of two publishes payloads of two words by a release store of a flag, the other looks by an acquire load.
// seen[pair]: 0 not published yet, 1 published and whole, 2 torn. Either may come first: neither waits.
kernel void publish(global uint* payload, global uint* flags, global uint* seen, uint pairs, uint distance) {
  const uint pair = pair_of_item(distance);
  if (pair >= pairs) return;
  if ((get_group_id(0) & distance) == 0) {
    wt_store_relaxed_u32(payload + 2 * pair, 2 * pair + 1);
    wt_store_relaxed_u32(payload + 2 * pair + 1, ~(2 * pair + 1));
    wt_store_release_u32(flags + pair, 1u);
  } else if (wt_load_acquire_u32(flags + pair) != 0) {
    const uint a = wt_load_relaxed_u32(payload + 2 * pair);
    const uint b = wt_load_relaxed_u32(payload + 2 * pair + 1);
    seen[pair] = a == 2 * pair + 1 && b == ~a ? 1u : 2u;
  }
}

// Does the same with one wide word, a claim by 32-bit compare-and-swap, and the fence alone: each pair has one winner.
// A loser that sees the flag but not the owner's word clears the word, which the host finds.
kernel void claim(global uint* owners, global ulong* words, global uint* flags, global uint* wins, uint pairs,
                  uint distance) {
  const uint pair = pair_of_item(distance);
  if (pair >= pairs) return;
  const uint owner = (uint)get_global_id(0) + 1;
  if (wt_compare_swap_u32(owners + pair, 0u, owner) == 0) {
    const ulong before = wt_compare_swap_u64(words + pair, 0ul, owner);
    wt_fence();
    wt_store_relaxed_u32(flags + pair, 1u);
    wt_fetch_add_u32(wins + pair, before == 0 ? 1u : 2u);
  } else if (wt_load_relaxed_u32(flags + pair) != 0) {
    wt_fence();
    if (wt_load_acquire_u64(words + pair) != wt_load_relaxed_u32(owners + pair)) {
      wt_store_release_u64(words + pair, 0ul);
    }
  }
}
