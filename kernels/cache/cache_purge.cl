// SPDX-License-Identifier: Apache-2.0
// cache_purge: removes entries of every region that were neither written nor used since `keep_from`, and those that
// were withdrawn.
// Work-item (x, r) takes WT_ENTRIES_PER_ITEM entries of region r; no other kernel uses the table meanwhile.
#include "lib/cache_table.clh"

inline bool is_old(const global wt_cache_entry* entries, const global uint* uses, uint slot, uint keep_from) {
  const global wt_cache_entry* e = entries + slot;
  return e->version != 0 && (max(e->time, uses[slot]) < keep_from || e->time == WT_NONE);
}

#ifdef WT_CACHE_CHAINED
// A tree cannot remove its nodes: old[r] becomes the number of old entries of region r, and the host clears regions.
kernel void cache_purge(const global wt_cache_entry* entries, const global uint* heads, global uint* used,
                        const global wt_cache_region* regions, global wt_cache_counters* counters, uint keep_from,
                        global uint* old, const global uint* uses) {
  const uint r = get_global_id(1), first = get_global_id(0) * WT_ENTRIES_PER_ITEM;
  const uint filled = min(used[r], regions[r].entries);
  if (first >= filled) return;
  const uint end = first + min((uint)WT_ENTRIES_PER_ITEM, filled - first);
  uint count = 0;
  for (uint k = first; k < end; ++k) count += is_old(entries, uses, regions[r].first_entry + k, keep_from);
  if (count > 0) wt_fetch_add_u32(old + r, count);
}
#else
kernel void cache_purge(global wt_cache_entry* entries, global uint* heads, global uint* used,
                        const global wt_cache_region* regions, global wt_cache_counters* counters, uint keep_from,
                        global uint* old, const global uint* uses) {
  const wt_cache cache = {entries, heads, used, regions, counters};
  const uint r = get_global_id(1), first = get_global_id(0) * WT_ENTRIES_PER_ITEM;
  if (first >= regions[r].entries) return;
  const uint end = first + min((uint)WT_ENTRIES_PER_ITEM, regions[r].entries - first);
  uint count = 0;
  for (uint k = first; k < end; ++k) {
    const uint slot = regions[r].first_entry + k;
    if (!is_old(entries, uses, slot, keep_from)) continue;
    wt_cache_remove(cache, slot);
    ++count;
  }
  if (count == 0) return;
#ifdef WT_CACHE_CONCURRENT
  wt_fetch_add_u32(used + r, 0u - count);
#endif
  wt_fetch_add_u32(&counters->evicted, count);
}
#endif
