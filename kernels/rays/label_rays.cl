// SPDX-License-Identifier: Apache-2.0
// label_rays: fills the planes of launched rays that say where they come from: the sample, the primitive that was left,
// the transmitter, and the cache entry before. Samples are first_sample + k, or first_sample + order[k] where rays were
// launched in an order (WT_ORDERED), or they stay as they are (WT_KEEP_SAMPLES).
#include "lib/hit.clh"

kernel void label_rays(global float* rays, uint capacity, uint first_slot, uint count, uint first_sample,
                       const global uint* order) {
  const uint first = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (first >= count) return;
  const uint end = first + min((uint)WT_RAYS_PER_ITEM, count - first);
  for (uint k = first; k < end; ++k) {
    const uint i = first_slot + k;
#ifdef WT_ORDERED
    wt_store_word(rays, capacity, WT_RAY_SAMPLE, i, first_sample + order[k]);
#elif !defined(WT_KEEP_SAMPLES)
    wt_store_word(rays, capacity, WT_RAY_SAMPLE, i, first_sample + k);
#endif
    wt_store_word(rays, capacity, WT_RAY_LEFT, i, WT_NONE);
    wt_store_word(rays, capacity, WT_RAY_REGION, i,
                  wt_load_word(rays, capacity, WT_RAY_NODE, i) & ~(WT_ROOT | WT_QUARTER_BITS));
    wt_store_word(rays, capacity, WT_RAY_ENTRY, i, WT_NONE);
  }
}
