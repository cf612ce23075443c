// SPDX-License-Identifier: Apache-2.0
// cache_groups: the rays of one key that the ray cache did not answer are a group. The first of them in the queue is
// traced; the others take its hit. Consumes a labelled queue and missed[i], which is i where ray i is to be traced.
//   cache_keys    the key of each ray as words that lie together; places[i] says whether it has one
//   cache_elect   each ray finds the place of its key in a table of ray numbers, which keeps the lowest
//   cache_follow  missed[i] of all but the lowest becomes WT_NONE, and places[i] is the ray that they follow
//   cache_share   followers take the hit of the ray that they follow, or are traced themselves where it cannot be
//                 theirs: the rules are those of a look-up (WT_CACHE_OWN_POINT, WT_CACHE_PRECISION)
// Rays that the cache does not serve form no groups. A work-item takes WT_RAYS_PER_ITEM rays (1 on GPUs).
#include "lib/cache_path.clh"
#include "wavetracer/device/arguments.h"

// The words of a key: those that wt_cache_same_key compares, and the transmitter.
#ifdef WT_CACHE_EXACT
#define WT_GROUP_WORDS 4u
#else
#define WT_GROUP_WORDS 2u
#endif

inline ulong wt_group_word(uint low, uint high) { return low | (ulong)high << 32; }

kernel void cache_keys(const global float* rays, uint capacity, uint count, const global float* missed,
                       wt_cache_widths widths, uint static_surfaces, global ulong* keys, global uint* places) {
  const uint first = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (first >= count) return;
  const uint end = first + min((uint)WT_RAYS_PER_ITEM, count - first);
  for (uint i = first; i < end; ++i) {
    const wt_cache_question q = wt_cache_ask(rays, capacity, i, 0, widths, 0);
    global ulong* key = keys + WT_GROUP_WORDS * (size_t)i;
    key[0] = wt_group_word(q.left, q.region);
#ifdef WT_CACHE_EXACT
    key[1] = wt_group_word(as_uint(q.direction.x), as_uint(q.direction.y));
    key[2] = wt_group_word(as_uint(q.direction.z), as_uint(q.origin.x));
    key[3] = wt_group_word(as_uint(q.origin.y), as_uint(q.origin.z));
#else
    key[1] = q.cells;
#endif
    const bool grouped = as_uint(missed[i]) != WT_NONE &&
                         wt_cache_may_ask(q, wt_load_word(rays, capacity, WT_RAY_SURFACE, i), static_surfaces);
    places[i] = grouped ? 0u : WT_NONE;
  }
}

// The place where the search for a key begins: its words mixed by the finisher of MurmurHash3.
inline uint wt_group_home(const ulong* key, uint mask) {
  ulong x = 0;
  for (uint word = 0; word < WT_GROUP_WORDS; ++word) {
    x = (x ^ key[word]) * 0xFF51AFD7ED558CCDul;
    x ^= x >> 33;
  }
  return (uint)(x * 0xC4CEB9FE1A85EC53ul >> 32) & mask;
}

inline bool wt_group_same(const ulong* a, const global ulong* b) {
  bool same = true;
  for (uint word = 0; word < WT_GROUP_WORDS; ++word) same = same && a[word] == b[word];
  return same;
}

// The place of ray i's key in the table, which has more places than keys, so that a search ends.
inline uint wt_group_place(const global ulong* keys, const ulong* key, uint home, uint i, volatile global uint* table,
                           uint mask) {
  for (uint place = home;; place = (place + 1) & mask) {
    uint found = wt_load_relaxed_u32(table + place);
    if (found == WT_NONE) found = wt_compare_swap_relaxed_u32(table + place, WT_NONE, i);
    if (found == WT_NONE) return place;
    if (!wt_group_same(key, keys + WT_GROUP_WORDS * (size_t)found)) continue;
    if (i < found) wt_fetch_min_u32(table + place, i);
    return place;
  }
}

kernel void cache_elect(uint count, const global ulong* keys, global uint* table, uint mask, global uint* places) {
  const uint first = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (first >= count) return;
  const uint end = first + min((uint)WT_RAYS_PER_ITEM, count - first);
  for (uint next = first; next < end; next += WT_AHEAD) {
    ulong ahead_keys[WT_AHEAD * WT_GROUP_WORDS];
    uint homes[WT_AHEAD];
    const uint ahead = min((uint)WT_AHEAD, end - next);
    for (uint k = 0; k < ahead; ++k) {
      ulong* key = ahead_keys + WT_GROUP_WORDS * k;
      for (uint word = 0; word < WT_GROUP_WORDS; ++word) key[word] = keys[WT_GROUP_WORDS * (size_t)(next + k) + word];
      homes[k] = wt_group_home(key, mask);
      wt_prefetch(table + homes[k]);
    }
    if (WT_AHEAD > 1)
      for (uint k = 0; k < ahead; ++k) {
        const uint found = wt_load_relaxed_u32(table + homes[k]);
        if (found != WT_NONE) wt_prefetch(keys + WT_GROUP_WORDS * (size_t)found);
      }
    for (uint k = 0; k < ahead; ++k)
      if (places[next + k] != WT_NONE)
        places[next + k] = wt_group_place(keys, ahead_keys + WT_GROUP_WORDS * k, homes[k], next + k, table, mask);
  }
}

// Sets places[i] to the ray that ray i follows, WT_NONE where it follows none.
kernel void cache_follow(uint count, global float* missed, const global uint* table, global uint* places) {
  const uint first = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (first >= count) return;
  const uint end = first + min((uint)WT_RAYS_PER_ITEM, count - first);
  for (uint i = first; i < end; ++i) {
    if (places[i] == WT_NONE) continue;
    const uint representative = table[places[i]];
    places[i] = representative == i ? WT_NONE : representative;
    if (representative != i) missed[i] = as_float(WT_NONE);
  }
}

// Sets refused[i], and missed[i], to i where ray i must be traced after all; else refused[i] is WT_NONE.
kernel void cache_share(global float* rays, global float* hits, global float* missed, global float* refused,
                        const global uint* representatives, global wt_cache_entry* entries, global uint* heads,
                        global uint* used, const global wt_cache_region* regions, global wt_cache_counters* counters,
                        const global wt_surface* surfaces, global uint* receivers, wt_cache_lookup_arguments args) {
  const wt_cache cache = {entries, heads, used, regions, counters};
  const uint first = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (first >= args.count) return;
  const uint end = first + min((uint)WT_RAYS_PER_ITEM, args.count - first);
  for (uint i = first; i < end; ++i) {
    refused[i] = as_float(WT_NONE);
    const uint from = representatives[i];
    if (from == WT_NONE) continue;
    const wt_cache_question q = wt_cache_ask(rays, args.capacity, i, 0, args.widths, args.now),
                            traced = wt_cache_ask(rays, args.capacity, from, 0, args.widths, args.now);
    wt_cache_entry e = wt_cache_answer(traced, hits[from], wt_load_word(hits, args.capacity, WT_HIT_PRIMITIVE, from),
                                       wt_load_word(hits, args.capacity, WT_HIT_SURFACE, from), WT_NONE);
    bool takes = wt_cache_stands(&e, q, regions[q.region]);
#if defined(WT_CACHE_OWN_POINT) && !defined(WT_CACHE_EXACT)
    if (takes && e.surface != WT_NONE) takes = wt_cache_meets(q, surfaces + e.surface, &e.t);
#endif
    if (!takes) {
      refused[i] = missed[i] = as_float(i);
      continue;
    }
    hits[i] = e.t;
    wt_store_word(hits, args.capacity, WT_HIT_PRIMITIVE, i, e.primitive);
    wt_store_word(hits, args.capacity, WT_HIT_SURFACE, i, e.surface);
#if !defined(WT_CACHE_OWN_POINT) && !defined(WT_CACHE_EXACT)
    wt_store_float3(rays, args.capacity, WT_RAY_ORIGIN, i, traced.origin);
    wt_store_float3(rays, args.capacity, WT_RAY_DIRECTION, i, traced.direction);
#endif
#ifdef WT_CACHE_ALL
    receivers[i] = receivers[from];
#endif
#ifdef WT_CACHE_STATISTICS
    wt_cache_link_path(cache, rays, args.capacity, i, wt_load_word(rays, args.capacity, WT_RAY_ENTRY, from));
#endif
  }
}
