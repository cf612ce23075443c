// SPDX-License-Identifier: Apache-2.0
// The open-addressed table as the thesis prints it (A. Zhdanov, TU Munich, 2014, listings C.1 and C.3), with its
// faults. bench_cache and the tests of lib/cache_open.clh compare with it; the program does not use it.
// Atomics have the orders of lib/memory_order.clh, which the listing leaves to chance. Assumes cleared nodes, position
// stamps that are not 0, WT_NODES (the listing's num_of_buckets) and WT_READERS (cache_readers_number).
#include "lib/memory_order.clh"
#include "wavetracer/device/records.h"

// CacheNode with the members that the two functions use, and a result like ours.
typedef struct {
  uint hash;
  float next_origin[3];
  float next_direction[3];
  float t;
  uint primitive, surface;
  uint used, timestamp, pos_hash, hit;
  uint write_lock, read_lock, read_n;
} thesis_node;

inline uint thesis_separate_by_4(uint x) {
  x &= 0x0000007Fu;
  x = (x ^ (x << 16)) & 0x0070000Fu;
  x = (x ^ (x << 8)) & 0x40300C03u;
  x = (x ^ (x << 4)) & 0x42108421u;
  return x;
}

// cache_hash3: signed products and sums wrap, as they did on the device.
inline uint thesis_hash(uint primitive, uint instance, uint x, uint y, uint z) {
  const uint numbers[5] = {primitive, instance, x, y, z};
  const long p = (1l << 32) - 5;
  long s = 0, zi = 1;
  for (int i = 0; i < 5; ++i) {
    const long xi = (int)(numbers[i] * 0x5067D19Du) >> 1;
    s = (s + zi * xi) % p;
    zi = zi * 0x64B6055Al % p;
  }
  s = (long)((ulong)s + (ulong)zi * (ulong)(p - 1)) % p;
  const uint morton = thesis_separate_by_4(x) | thesis_separate_by_4(y) << 1 | thesis_separate_by_4(z) << 2 |
                      thesis_separate_by_4(instance) << 3 | thesis_separate_by_4(primitive) << 4;
  return (uint)s + morton;
}

// Implements getBucketIndex. The largest hashes reach no further than the middle of the table.
inline uint thesis_bucket(uint hash) { return (uint)(((float)hash / 4294967295.0f) * (WT_NODES - 1) / 2); }

inline uint thesis_hash_of(ulong cells, uint left) {
  return thesis_hash(left, left >> 1, (uint)cells & 0x1FFFFFu, (uint)(cells >> 21) & 0x1FFFFFu, (uint)(cells >> 42));
}

// Implements writeToCache. Returns false if another work-item holds the write lock, perhaps for ever.
inline bool thesis_write(volatile global thesis_node* nodes, uint hash, float t, uint primitive, uint surface,
                         uint pos_hash) {
  volatile global thesis_node* node = nodes + thesis_bucket(hash);
  if (wt_compare_swap_u32(&node->write_lock, 0u, 1u) != 0) return false;
  node->hash = hash;
  for (int k = 0; k < 3; ++k) {
    node->next_origin[k] = 0.0f;
    node->next_direction[k] = 0.0f;
  }
  node->t = t;
  node->primitive = primitive;
  node->surface = surface;
  node->used = 1;
  node->pos_hash = pos_hash;
  node->timestamp = 1;
  wt_store_release_u32(&node->read_lock, 0u);
  return true;
}

// Implements getFromCache. The bound of atomicInc is never reached, as the count returns to 0 one read before.
inline bool thesis_read(volatile global thesis_node* nodes, uint hash, uint pos_hash, float* t, uint* primitive,
                        uint* surface) {
  volatile global thesis_node* node = nodes + thesis_bucket(hash);
  if (wt_compare_swap_u32(&node->read_lock, 0u, 1u) != 0) return false;
  if (node->pos_hash != pos_hash) {
    wt_store_relaxed_u32(&node->read_n, 0u);
    wt_store_release_u32(&node->write_lock, 0u);
    return false;
  }
  const uint i = wt_fetch_add_u32(&node->read_n, 1u);
  node->hit++;
  *t = node->t;
  *primitive = node->primitive;
  *surface = node->surface;
  if (i < WT_READERS - 1) {
    wt_store_release_u32(&node->read_lock, 0u);
  } else {
    wt_store_relaxed_u32(&node->read_n, 0u);
    wt_store_release_u32(&node->write_lock, 0u);
  }
  return true;
}

// Stores the same values as probe_cache_rate.cl. taken[i]: whether it was written.
kernel void thesis_put(global thesis_node* nodes, const global ulong* cells, const global uint* left, uint count,
                       uint pos_hash, global uint* taken) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const uint primitive = (uint)(cells[i] ^ cells[i] >> 32) + left[i];
  taken[i] =
      thesis_write(nodes, thesis_hash_of(cells[i], left[i]), (float)(primitive >> 8), primitive, ~primitive, pos_hash);
}

kernel void thesis_find(global thesis_node* nodes, const global ulong* cells, const global uint* left, uint count,
                        uint pos_hash, global float* t, global uint* primitives, global uint* surfaces) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  float found_t = 0.0f;
  uint primitive = WT_NONE, surface = WT_NONE;
  thesis_read(nodes, thesis_hash_of(cells[i], left[i]), pos_hash, &found_t, &primitive, &surface);
  t[i] = found_t;
  primitives[i] = primitive;
  surfaces[i] = surface;
}

// Adds the number of written nodes to *written.
kernel void thesis_count(const global thesis_node* nodes, global uint* written) {
  const uint i = (uint)get_global_id(0);
  if (i < WT_NODES && nodes[i].used) wt_fetch_add_u32(written, 1u);
}
