// cache_store: rays that were traced because the cache had no answer. Consumes missed[k], its hit, and indices[k],
// which ray of the whole queue it is; produces that ray's hit, and an entry. One missed ray a work-item.
// With WT_CACHE_STATISTICS entries are linked along paths; with WT_CACHE_ALL they keep receptions[k], the first
// receiver that the segment passed.
#include "lib/cache_path.clh"
#include "lib/cache_table.clh"

kernel void cache_store(global float* rays, uint capacity, const global float* missed, const global float* missed_hits,
                        uint missed_capacity, uint missed_count, const global uint* indices, global float* hits,
                        global wt_cache_entry* entries, global uint* heads, global uint* used,
                        const global wt_cache_region* regions, global wt_cache_counters* counters,
                        wt_cache_widths widths, uint now, uint static_surfaces, const global uint* receptions) {
  const wt_cache cache = {entries, heads, used, regions, counters};
  const uint k = get_global_id(0);
  if (k >= missed_count) return;
  const uint i = indices[k];
  const float t = missed_hits[k];
  const uint primitive = wt_load_word(missed_hits, missed_capacity, WT_HIT_PRIMITIVE, k);
  const uint surface = wt_load_word(missed_hits, missed_capacity, WT_HIT_SURFACE, k);
  hits[i] = t;
  wt_store_word(hits, capacity, WT_HIT_PRIMITIVE, i, primitive);
  wt_store_word(hits, capacity, WT_HIT_SURFACE, i, surface);

  const wt_cache_question q = wt_cache_ask(missed, missed_capacity, k, widths, now);
  uint slot = WT_NONE;
  if (wt_cache_may_ask(q, wt_load_word(missed, missed_capacity, WT_RAY_SURFACE, k), static_surfaces)) {
#ifdef WT_CACHE_ALL
    const uint receiver = receptions[k];
#else
    const uint receiver = WT_NONE;
#endif
    const wt_cache_entry e = wt_cache_answer(q, t, primitive, surface, receiver);
    slot = wt_cache_put(cache, q, &e);
  }
#ifdef WT_CACHE_STATISTICS
  wt_cache_link_path(cache, rays, capacity, i, slot);
#endif
}
