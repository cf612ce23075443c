// SPDX-License-Identifier: Apache-2.0
// Kernels that only bench_cache runs: operations of a ray cache's table per second, and the limit of memory. Questions
// are arrays, read in order, one per work-item. All are about region 0.
#include "probe_question.clh"

// Returns the value that is stored under a key.
inline uint rate_primitive(ulong cells, uint left) { return (uint)(cells ^ cells >> 32) + left; }

// Question i asks for key first + i or, with askers, for one of `keys` keys from `first` on; a random key is drawn for
// each group of `askers` questions in a row.
kernel void make_questions(uint first, uint keys, uint askers, global ulong* cells, global uint* left, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const uint key = first + (askers ? (uint)((probe_mix(~(ulong)(i / askers)) >> 32) * keys >> 32) : i);
  cells[i] = probe_mix(key + 1ul) >> 1;  // for key 0 all values would be 0, which means a miss
  left[i] = key >> 2;
}

#ifdef WT_CACHE_TALLY
// The group adds up the counts of its puts, as cache_store does.
kernel void put_questions(global wt_cache_entry* entries, global uint* heads, global uint* used,
                          const global wt_cache_region* regions, global wt_cache_counters* counters,
                          wt_cache_widths widths, const global ulong* cells, const global uint* left, uint count) {
  local uint stored, claimed;
  wt_cache_tally tally = {0, 0};
  const wt_cache cache = {entries, heads, used, regions, counters, &tally};
  if (get_local_id(0) == 0) stored = claimed = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint i = (uint)get_global_id(0);
  if (i < count) {
    const wt_cache_question q = probe_ask(cells[i], left[i], widths, 1u);
    const uint primitive = rate_primitive(q.cells, q.left);
    const wt_cache_entry e = wt_cache_answer(q, (float)(primitive >> 8), primitive, ~primitive, WT_NONE);
    wt_cache_put(cache, q, &e);
  }
  if (tally.stored) atomic_add(&stored, tally.stored);
  if (tally.claimed) atomic_add(&claimed, tally.claimed);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (get_local_id(0) > 0) return;
  if (stored) wt_fetch_add_u32(&counters->stored, stored);
  if (claimed) wt_fetch_add_u32(used, claimed);
}
#endif

// Writes answers as planes of t, primitive and surface, as in a hit list.
kernel void find_questions(global wt_cache_entry* entries, global uint* heads, global uint* used,
                           const global wt_cache_region* regions, global wt_cache_counters* counters,
                           wt_cache_widths widths, const global ulong* cells, const global uint* left, uint count,
                           global float* t, global uint* primitives, global uint* surfaces) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const wt_cache cache = {entries, heads, used, regions, counters};
  const wt_cache_question q = probe_ask(cells[i], left[i], widths, 1u);
  uint slot;
  wt_cache_entry answer;
  const bool found = wt_cache_find(cache, q, &answer, &slot);
  t[i] = found ? answer.t : 0.0f;
  primitives[i] = found ? answer.primitive : WT_NONE;
  surfaces[i] = found ? answer.surface : WT_NONE;
}

// outcome: hits, and hits that are wrong.
kernel void check_answers(const global ulong* cells, const global uint* left, uint count, const global float* t,
                          const global uint* primitives, const global uint* surfaces, global uint* outcome) {
  const uint i = (uint)get_global_id(0);
  if (i >= count || primitives[i] == WT_NONE) return;
  const uint primitive = rate_primitive(cells[i], left[i]);
  wt_fetch_add_u32(outcome, 1u);
  if (primitives[i] != primitive || surfaces[i] != ~primitive || t[i] != (float)(primitive >> 8))
    wt_fetch_add_u32(outcome + 1, 1u);
}

kernel void hash_questions(wt_cache_widths widths, const global ulong* cells, const global uint* left, uint count,
                           global uint* out) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  out[i] = (uint)(wt_cache_hash(WT_CACHE_HASH_METHOD, cells[i], left[i], left[i] >> 1, widths) >> 32);
}

// Computes, for the rays of a labelled queue, everything that precedes the memory access of a question.
kernel void hash_rays(const global float* rays, uint capacity, uint count, wt_cache_widths widths, global uint* out) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const wt_cache_question q = wt_cache_ask(rays, capacity, i, 0, widths, 1u);
  out[i] = (uint)(q.hash >> 32) ^ q.region;
}

// Measures random accesses, one per work-item: slots of 64 bytes, which are read completely, and words of eight.
kernel void gather_slots(const global ulong2* slots, uint slot_count, uint count, global uint* out) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const global ulong2* slot = slots + 4 * (size_t)wt_cache_bucket(probe_mix(i), slot_count);
  const ulong2 all = slot[0] ^ slot[1] ^ slot[2] ^ slot[3];
  out[i] = (uint)(all.x ^ all.y);
}

kernel void gather_words(const global ulong* words, uint word_count, uint count, global uint* out) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  out[i] = (uint)words[wt_cache_bucket(probe_mix(i), word_count)];
}
