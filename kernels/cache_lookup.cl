// SPDX-License-Identifier: Apache-2.0
// cache_lookup: rays of a labelled queue ask the cache. Consumes rays; produces hits[i] where the cache answers.
// missed[i] is i where ray i is to be traced, else WT_NONE. A work-item takes WT_RAYS_PER_ITEM rays (1 on GPUs).
//   WT_CACHE_OWN_POINT   an answer names the surface, and the ray meets its plane itself; else the ray is replaced by
//                        the one that was traced
//   WT_CACHE_STATISTICS  counts hits per entry, keeps the cycles of its last answer, and links entries along paths, by
//                        the plane WT_RAY_ENTRY
//   WT_CACHE_ALL         entries hold what moves, too: those that movement has made wrong are withdrawn, but by the
//                        thesis' tables as printed (WT_CACHE_THESIS)
#include "lib/cache_path.clh"
#include "lib/cache_table.clh"
#include "lib/clock.clh"
#include "wavetracer/device/arguments.h"

// The things that move, with WT_CACHE_ALL; else placeholders.
typedef struct {
  const global float* receivers;  // four floats per receiver: centre and padding
  float radius;                   // m
  const global wt_exact_surface* surfaces;
  const global uint* instance_since;
} wt_cache_movement;

#ifdef WT_CACHE_ALL
inline bool instance_moved(wt_cache_movement movement, uint surface, uint time) {
  if (surface == WT_NONE) return false;
  const uint instance = movement.surfaces[surface].instance;
  return instance != WT_NONE && movement.instance_since[instance] > time;
}

// Section 3.2.3: the surface that the ray left or met has moved since, or the receiver is no longer within reach of the
// segment (algorithm 4, but with its distance in place of one component, and measured from the segment instead of its
// origin).
inline bool outdated(wt_cache_movement movement, const wt_cache_entry* e, uint left_surface) {
  if (instance_moved(movement, e->surface, e->time)) return true;
  if (e->left != WT_NONE && instance_moved(movement, left_surface, e->time)) return true;
  if (e->receiver == WT_NONE) return false;
  const float3 to = vload3(0, movement.receivers + 4 * (size_t)e->receiver) - vload3(0, e->origin);
  const float3 direction = vload3(0, e->direction);
  const float3 off = to - clamp(dot(to, direction), 0.0f, e->t) * direction;
  return dot(off, off) > movement.radius * movement.radius;
}
#endif

// The entry that answers ray i, or WT_NONE.
inline uint look_up(wt_cache cache, wt_cache_question q, uint left_surface, uint static_surfaces,
                    const global wt_surface* surfaces, wt_cache_movement movement, wt_cache_entry* e) {
  uint slot;
  if (!wt_cache_may_ask(q, left_surface, static_surfaces) || !wt_cache_find(cache, q, e, &slot)) return WT_NONE;
#if defined(WT_CACHE_ALL) && !defined(WT_CACHE_THESIS)  // the thesis' listings never ask this
  if (outdated(movement, e, left_surface)) {
    wt_cache_withdraw(cache, slot);
    wt_fetch_add_u32(&cache.counters->stale, 1u);
    return WT_NONE;
  }
#endif
#if defined(WT_CACHE_OWN_POINT) && !defined(WT_CACHE_EXACT)
  if (e->surface != WT_NONE && !wt_cache_meets(q, surfaces + e->surface, &e->t)) return WT_NONE;
#endif
  return slot;
}

kernel void cache_lookup(global float* rays, global float* hits, global float* missed, global wt_cache_entry* entries,
                         global uint* heads, global uint* used, const global wt_cache_region* regions,
                         global wt_cache_counters* counters, const global wt_surface* surfaces,
                         const global wt_exact_surface* exact_surfaces, const global float* receivers,
                         const global uint* instance_since, global uint* receptions, global uint* entry_hits,
                         global uint* uses, global wt_cache_cycles* cycles, wt_cache_lookup_arguments args) {
  const wt_cache cache = {entries, heads, used, regions, counters};
  const wt_cache_movement movement = {receivers, args.radius_m, exact_surfaces, instance_since};
  const uint first = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (first >= args.count) return;
  const uint end = first + min((uint)WT_RAYS_PER_ITEM, args.count - first);
  for (uint next = first; next < end; next += WT_AHEAD) {
    wt_cache_question questions[WT_AHEAD];
    const uint ahead = min((uint)WT_AHEAD, end - next);
    for (uint k = 0; k < ahead; ++k) {
      questions[k] = wt_cache_ask(rays, args.capacity, next + k, exact_surfaces, args.widths, args.now);
      wt_cache_prefetch_home(cache, questions[k]);
    }
    if (WT_AHEAD > 1)
      for (uint k = 0; k < ahead; ++k) wt_cache_prefetch_entry(cache, questions[k], false);
    for (uint k = 0; k < ahead; ++k) {
      const uint i = next + k, left_surface = wt_load_word(rays, args.capacity, WT_RAY_SURFACE, i);
      wt_cache_entry e;
#ifdef WT_CACHE_STATISTICS
      const ulong before = wt_clock();
#endif
      const uint slot = look_up(cache, questions[k], left_surface, args.static_surfaces, surfaces, movement, &e);
      wt_store_word(missed, args.capacity, 0, i, slot == WT_NONE ? i : WT_NONE);
#ifdef WT_CACHE_ALL
      receptions[i] = slot == WT_NONE ? WT_NONE : e.receiver;
#endif
      if (slot == WT_NONE) continue;
      hits[i] = e.t;
      wt_store_word(hits, args.capacity, WT_HIT_PRIMITIVE, i, e.primitive);
      wt_store_word(hits, args.capacity, WT_HIT_SURFACE, i, e.surface);
#if !defined(WT_CACHE_OWN_POINT) && !defined(WT_CACHE_EXACT)
      wt_store_float3(rays, args.capacity, WT_RAY_ORIGIN, i, vload3(0, e.origin));
      wt_store_float3(rays, args.capacity, WT_RAY_DIRECTION, i, vload3(0, e.direction));
#endif
#ifdef WT_CACHE_STATISTICS
      cycles[slot].read = wt_cycles_since(before);
      wt_fetch_add_u32(entry_hits + slot, 1u);
      wt_cache_link_path(cache, rays, args.capacity, i, slot);
#endif
      if (args.touch) wt_store_relaxed_u32(uses + slot, args.now);
    }
  }
}
