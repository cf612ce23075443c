// SPDX-License-Identifier: Apache-2.0
// Kernels that only tests and benchmarks run: the ray cache's table under operations whose outcome a host can check.
// Keys are numbers. A key, and the value stored under it, are functions of its number and of the frame of writing, so
// that an answer that is torn, of another key or of another frame is detected. Global sizes may exceed the work.
#include "probe_question.clh"

inline wt_cache probe_cache(global wt_cache_entry* entries, global uint* heads, global uint* used,
                            const global wt_cache_region* regions, global wt_cache_counters* counters) {
  const wt_cache cache = {entries, heads, used, regions, counters};
  return cache;
}

inline ulong probe_cells(uint number) { return probe_mix(number) >> 1; }

#define PROBE_FRAMES 4u

// Four keys in a row share their primitive. Exact ones share their cells as well, and only their rays tell them apart.
// Quantised keys have other rays in each frame, at least 1 apart: with the purge by precision, an entry of one frame is
// not valid in another, and is overwritten again and again.
inline wt_cache_question probe_key(uint key, uint now, uint regions, wt_cache_widths widths) {
#ifdef WT_CACHE_EXACT
  const uint ray = key, number = key >> 2;
#else
  const uint ray = PROBE_FRAMES * key + now, number = key;
#endif
  wt_cache_question q = probe_ask(probe_cells(number), key >> 2, widths, 0u);
  q.origin = (float3)((float)(ray & 0xFFFFFF), (float)(ray & 3), (float)(ray >> 24));
  q.direction = -q.origin;
  q.region = (key >> 2) % regions;
  q.now = now;
  return q;
}

inline wt_cache_entry probe_entry(wt_cache_question q, uint key) {
  const ulong payload = probe_mix((ulong)q.now << 32 | key);
  wt_cache_entry e = wt_cache_answer(q, (float)((uint)payload & 0xFFFFFF), (uint)(payload >> 24), (uint)(payload >> 32),
                                     (uint)payload);
  e.next = key;
  return e;
}

// Tells whether the answer is exactly a value that was once stored under this key.
inline bool probe_whole(const wt_cache_entry* e, uint key, uint regions, wt_cache_widths widths) {
  const wt_cache_question q = probe_key(key, e->time, regions, widths);
  const wt_cache_entry is = probe_entry(q, key);
  return e->cells == is.cells && e->left == is.left && e->t == is.t && e->primitive == is.primitive &&
         e->surface == is.surface && e->next == key && e->receiver == is.receiver && e->origin[0] == is.origin[0] &&
         e->origin[1] == is.origin[1] && e->origin[2] == is.origin[2] && e->direction[0] == is.direction[0] &&
         e->direction[1] == is.direction[1] && e->direction[2] == is.direction[2];
}

// Does operation i; one in four is a put. Keys are below `universe`; the first 64 of them get an eighth of all
// operations; frames are random. slots[key] becomes the slot that a put of the key returned.
// outcome: puts, finds, hits, hits that are wrong.
#define PROBE_RUN 16u  // operations per work-item
kernel void mixed_operations(global wt_cache_entry* entries, global uint* heads, global uint* used,
                             const global wt_cache_region* regions, global wt_cache_counters* counters,
                             uint region_count, wt_cache_widths widths, ulong operations, uint universe,
                             global uint* slots, global uint* outcome) {
  const wt_cache cache = probe_cache(entries, heads, used, regions, counters);
  const ulong first = get_global_id(0) * (ulong)PROBE_RUN, end = min(first + PROBE_RUN, operations);
  uint puts = 0, finds = 0, hits = 0, wrong = 0;
  for (ulong i = first; i < end; ++i) {
    const ulong random = probe_mix(i);
    const uint most = (random & 7) == 0 ? min(universe, 64u) : universe;
    const uint key = (uint)((random >> 32) * most >> 32), now = (uint)(random >> 8) % PROBE_FRAMES;
    const wt_cache_question q = probe_key(key, now, region_count, widths);
    uint slot;
    wt_cache_entry e;
    if ((random >> 3 & 3) == 0) {
      e = probe_entry(q, key);
      slot = wt_cache_put(cache, q, &e);
      if (slot != WT_NONE) wt_store_relaxed_u32(slots + key, slot);
      ++puts;
    } else {
      const bool found = wt_cache_find(cache, q, &e, &slot);
      ++finds;
      hits += found;
      wrong += found && !probe_whole(&e, key, region_count, widths);
    }
  }
  if (first >= end) return;
  wt_fetch_add_u32(outcome, puts);
  wt_fetch_add_u32(outcome + 1, finds);
  wt_fetch_add_u32(outcome + 2, hits);
  wt_fetch_add_u32(outcome + 3, wrong);
}

// Finds every key below `universe`: its slot in any frame, or WT_NONE, or WT_NONE - 1 if its answer is wrong.
kernel void find_keys(global wt_cache_entry* entries, global uint* heads, global uint* used,
                      const global wt_cache_region* regions, global wt_cache_counters* counters, uint region_count,
                      wt_cache_widths widths, uint universe, global uint* slots) {
  const uint key = (uint)get_global_id(0);
  if (key >= universe) return;
  const wt_cache cache = probe_cache(entries, heads, used, regions, counters);
  uint slot;
  wt_cache_entry e;
  bool found = false;
  for (uint now = 0; now < PROBE_FRAMES && !found; ++now)
    found = wt_cache_find(cache, probe_key(key, now, region_count, widths), &e, &slot);
  slots[key] = !found ? WT_NONE : probe_whole(&e, key, region_count, widths) ? slot : WT_NONE - 1;
}

// Puts the keys first .. first + count - 1. slots[key]: result of the put.
kernel void put_keys(global wt_cache_entry* entries, global uint* heads, global uint* used,
                     const global wt_cache_region* regions, global wt_cache_counters* counters, uint region_count,
                     wt_cache_widths widths, uint first, uint count, uint now, global uint* slots) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const wt_cache cache = probe_cache(entries, heads, used, regions, counters);
  const wt_cache_question q = probe_key(first + i, now, region_count, widths);
  const wt_cache_entry e = probe_entry(q, first + i);
  slots[first + i] = wt_cache_put(cache, q, &e);
}

// Tables of single rays: the value stored or returned for each is its hit's primitive. WT_NONE: dropped, or not found.
kernel void put_rays(global wt_cache_entry* entries, global uint* heads, global uint* used,
                     const global wt_cache_region* regions, global wt_cache_counters* counters, wt_cache_widths widths,
                     const global float* rays, uint capacity, uint count, uint now, const global uint* primitives,
                     global uint* slots) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const wt_cache_question q = wt_cache_ask(rays, capacity, i, 0, widths, now);
  const wt_cache_entry e = wt_cache_answer(q, 1.0f, primitives[i], 0, WT_NONE);
  slots[i] = wt_cache_put(probe_cache(entries, heads, used, regions, counters), q, &e);
}

kernel void find_rays(global wt_cache_entry* entries, global uint* heads, global uint* used,
                      const global wt_cache_region* regions, global wt_cache_counters* counters, wt_cache_widths widths,
                      const global float* rays, uint capacity, uint count, uint now, global uint* primitives) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  uint slot;
  wt_cache_entry e;
  const wt_cache_question q = wt_cache_ask(rays, capacity, i, 0, widths, now);
  const bool found = wt_cache_find(probe_cache(entries, heads, used, regions, counters), q, &e, &slot);
  primitives[i] = found ? e.primitive : WT_NONE;
}

// Empties the slots of a list. A chained table cannot give up a single entry.
#ifndef WT_CACHE_CHAINED
kernel void remove_slots(global wt_cache_entry* entries, global uint* heads, global uint* used,
                         const global wt_cache_region* regions, global wt_cache_counters* counters,
                         const global uint* slots, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i < count) wt_cache_remove(probe_cache(entries, heads, used, regions, counters), slots[i]);
}
#endif
