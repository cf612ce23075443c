// SPDX-License-Identifier: Apache-2.0
// Kernels that only tests run: keys, hashes and buckets of rays on the device.
// Each ray has three words: cells, hash, and tag above bucket.
#include "wavetracer/device/cache.h"

kernel void cache_keys(const global float* directions, const global uint* left, const global uint* surfaces, uint count,
                       uint division, uint method, wt_cache_widths widths, uint buckets, global ulong* out) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const ulong cells = wt_cache_cells(directions[3 * i], directions[3 * i + 1], directions[3 * i + 2], division);
  const ulong hash = wt_cache_hash(method, cells, left[i], surfaces[i], widths);
  out[3 * i] = cells;
  out[3 * i + 1] = hash;
  out[3 * i + 2] = (ulong)wt_cache_tag(cells, left[i]) << 32 | wt_cache_bucket(hash, buckets);
}
