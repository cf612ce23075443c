// SPDX-License-Identifier: Apache-2.0
// cache_store: stores rays that were traced because the cache had no answer. Consumes missed[k], its hit, and
// indices[k], the number of the ray in the whole queue; produces that ray's hit, and an entry. A work-item takes one
// missed ray.
// With WT_CACHE_STATISTICS entries are linked along paths and keep the cycles of their write. With WT_CACHE_ALL entries
// and receivers[i] keep receptions[k], the first receiver that the segment passed.
#include "lib/cache_path.clh"
#include "lib/cache_table.clh"
#include "lib/clock.clh"
#include "wavetracer/device/arguments.h"

// Stores the hit of missed ray k for the whole queue, and in the table.
inline void store_hit(wt_cache cache, wt_cache_question q, global float* rays, uint capacity,
                      const global float* missed, const global float* missed_hits, uint missed_capacity, uint k, uint i,
                      global float* hits, uint static_surfaces, const global uint* receptions, global uint* receivers,
                      global wt_cache_cycles* cycles) {
  const float t = missed_hits[k];
  const uint primitive = wt_load_word(missed_hits, missed_capacity, WT_HIT_PRIMITIVE, k);
  const uint surface = wt_load_word(missed_hits, missed_capacity, WT_HIT_SURFACE, k);
  hits[i] = t;
  wt_store_word(hits, capacity, WT_HIT_PRIMITIVE, i, primitive);
  wt_store_word(hits, capacity, WT_HIT_SURFACE, i, surface);
#ifdef WT_CACHE_ALL
  const uint receiver = receivers[i] = receptions[k];
#else
  const uint receiver = WT_NONE;
#endif
  uint slot = WT_NONE;
  if (wt_cache_may_ask(q, wt_load_word(missed, missed_capacity, WT_RAY_SURFACE, k), static_surfaces)) {
    const wt_cache_entry e = wt_cache_answer(q, t, primitive, surface, receiver);
#ifdef WT_CACHE_STATISTICS
    const ulong before = wt_clock();
    slot = wt_cache_put(cache, q, &e);
    if (slot != WT_NONE) cycles[slot].write = wt_cycles_since(before);
#else
    slot = wt_cache_put(cache, q, &e);
#endif
  }
#ifdef WT_CACHE_STATISTICS
  wt_cache_link_path(cache, rays, capacity, i, slot);
#endif
}

inline void flush_tally(wt_cache cache, uint region) {
  if (cache.tally->stored) wt_fetch_add_u32(&cache.counters->stored, cache.tally->stored);
  if (cache.tally->claimed) wt_fetch_add_u32(cache.used + region, cache.tally->claimed);
  cache.tally->stored = cache.tally->claimed = 0;
}

#ifdef WT_CPU
// A work-item takes a run of rays.
kernel void cache_store(global float* rays, const global float* missed, const global float* missed_hits,
                        const global uint* indices, global float* hits, global wt_cache_entry* entries,
                        global uint* heads, global uint* used, const global wt_cache_region* regions,
                        global wt_cache_counters* counters, const global wt_exact_surface* exact_surfaces,
                        const global uint* receptions, global uint* receivers, global wt_cache_cycles* cycles,
                        wt_cache_store_arguments args) {
  wt_cache_tally tally = {0, 0};
  const wt_cache cache = {entries, heads, used, regions, counters, &tally};
  const uint first = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (first >= args.missed_count) return;
  const uint end = first + min((uint)WT_RAYS_PER_ITEM, args.missed_count - first);
  uint region = wt_load_word(missed, args.missed_capacity, WT_RAY_REGION, first);
  for (uint next = first; next < end; next += WT_AHEAD) {
    wt_cache_question questions[WT_AHEAD];
    const uint ahead = min((uint)WT_AHEAD, end - next);
    for (uint j = 0; j < ahead; ++j) {
      questions[j] = wt_cache_ask(missed, args.missed_capacity, next + j, exact_surfaces, args.widths, args.now);
      wt_cache_prefetch_home(cache, questions[j]);
    }
    for (uint j = 0; j < ahead; ++j) wt_cache_prefetch_entry(cache, questions[j], true);
    for (uint j = 0; j < ahead; ++j) {
      if (questions[j].region != region) {
        flush_tally(cache, region);
        region = questions[j].region;
      }
      store_hit(cache, questions[j], rays, args.capacity, missed, missed_hits, args.missed_capacity, next + j,
                indices[next + j], hits, args.static_surfaces, receptions, receivers, cycles);
    }
  }
  flush_tally(cache, region);
}
#else
// A work-item takes one ray. Neighbours mostly belong to one region, for which the group adds up.
kernel void cache_store(global float* rays, const global float* missed, const global float* missed_hits,
                        const global uint* indices, global float* hits, global wt_cache_entry* entries,
                        global uint* heads, global uint* used, const global wt_cache_region* regions,
                        global wt_cache_counters* counters, const global wt_exact_surface* exact_surfaces,
                        const global uint* receptions, global uint* receivers, global wt_cache_cycles* cycles,
                        wt_cache_store_arguments args) {
  local uint stored, claimed, region;
  wt_cache_tally tally = {0, 0};
  const wt_cache cache = {entries, heads, used, regions, counters, &tally};
  const uint k = get_global_id(0);
  if (get_local_id(0) == 0) {
    stored = claimed = 0;
    region = wt_load_word(missed, args.missed_capacity, WT_RAY_REGION, min(k, args.missed_count - 1));
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (k < args.missed_count) {
    const wt_cache_question q = wt_cache_ask(missed, args.missed_capacity, k, exact_surfaces, args.widths, args.now);
    store_hit(cache, q, rays, args.capacity, missed, missed_hits, args.missed_capacity, k, indices[k], hits,
              args.static_surfaces, receptions, receivers, cycles);
    if (q.region != region) flush_tally(cache, q.region);
  }
  if (tally.stored) atomic_add(&stored, tally.stored);
  if (tally.claimed) atomic_add(&claimed, tally.claimed);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) > 0) return;
  tally.stored = stored;
  tally.claimed = claimed;
  flush_tally(cache, region);
}
#endif
