// SPDX-License-Identifier: Apache-2.0
// bitonic_sort: a stable sort of keys with a payload by comparators alone (K. Batcher, "Sorting networks and their
// applications", AFIPS 1968). It sorts blocks in local memory; above them it merges one step per launch, then blocks
// again.
//
// Every merge begins with a flip (position p meets its mirror image), so that each comparator puts the smaller key at
// the lower position. Positions from n on, if they existed, would hold infinity and never move, so every n works. Equal
// keys are compared by the position that each key had, its index, so they keep their order.
// Build options: WT_KEY_BITS (32, 64), WT_PAYLOAD (0 none, 1 words, 2 the indices themselves), WT_BLOCK (a power of
// two, 16 at least), WT_LANES (1: a work-group sorts a block; 16: one work-item does, in vectors of 16 keys).

#if WT_KEY_BITS == 64
typedef ulong wt_key;
typedef ulong16 wt_keys;
#define WT_TO_KEY_MASK convert_long16
#else
typedef uint wt_key;
typedef uint16 wt_keys;
#define WT_TO_KEY_MASK convert_int16
#endif

// A step pairs positions whose distance is `stride`, or mirrors groups of 2 * stride: mask is stride or 2 * stride - 1,
// and a position xor mask is its partner. This is the lower position of comparator c in a step.
inline uint wt_low(uint c, uint stride) { return 2 * c - (c & (stride - 1)); }

inline bool wt_after(wt_key a, uint a_index, wt_key b, uint b_index) { return a > b || (a == b && a_index > b_index); }

// The comparator of positions low < high: the smaller key goes to the lower one. In OpenCL 1.2 a pointer has one
// address space, so there is one function for each.
#define WT_COMPARATOR(space)                                                                              \
  inline void wt_compare_##space(space wt_key* keys, space uint* index, uint low, uint high) {            \
    const wt_key a = keys[low], b = keys[high];                                                           \
    const uint a_index = WT_PAYLOAD != 0 ? index[low] : 0u, b_index = WT_PAYLOAD != 0 ? index[high] : 0u; \
    if (!wt_after(a, a_index, b, b_index)) return;                                                        \
    keys[low] = b;                                                                                        \
    keys[high] = a;                                                                                       \
    if (WT_PAYLOAD != 0) {                                                                                \
      index[low] = b_index;                                                                               \
      index[high] = a_index;                                                                              \
    }                                                                                                     \
  }
WT_COMPARATOR(local)
WT_COMPARATOR(global)

#if WT_LANES == 1
// Makes the steps of one merge over a block of n keys, from the given stride down to 1; the first one has the given
// mask.
inline void wt_merge(local wt_key* keys, local uint* index, uint n, uint stride, uint mask) {
  while (stride != 0) {
    for (uint c = get_local_id(0); wt_low(c, stride) < n; c += get_local_size(0)) {
      const uint low = wt_low(c, stride), high = low ^ mask;
      if (high < n) wt_compare_local(keys, index, low, high);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    stride /= 2;
    mask = stride;
  }
}

inline void wt_sort(local wt_key* keys, local uint* index, uint n) {
  for (uint stride = 1; stride < n; stride *= 2) wt_merge(keys, index, n, stride, 2 * stride - 1);
}
#else
typedef struct {
  wt_keys key;
  uint16 index;
} wt_vector;

// Rearranges the lanes of a vector, all in the same way; the names of the lanes are OpenCL's.
#define WT_REARRANGED(v, lanes) ((wt_vector){(v).key.lanes, (v).index.lanes})

inline wt_vector wt_load(const local wt_key* keys, const local uint* index, uint i) {
  const wt_vector v = {vload16(0, keys + i), WT_PAYLOAD != 0 ? vload16(0, index + i) : (uint16)(0)};
  return v;
}

inline void wt_store(wt_vector v, local wt_key* keys, local uint* index, uint i) {
  vstore16(v.key, 0, keys + i);
  if (WT_PAYLOAD != 0) vstore16(v.index, 0, index + i);
}

// Lanes of b where `take` is set, else of a.
inline wt_vector wt_choose(wt_vector a, wt_vector b, int16 take) {
  const wt_vector v = {select(a.key, b.key, WT_TO_KEY_MASK(take)), select(a.index, b.index, take)};
  return v;
}

inline int16 wt_lanes_after(wt_vector a, wt_vector b) {
  const int16 after = convert_int16(a.key > b.key);
  return WT_PAYLOAD == 0 ? after : after | (convert_int16(a.key == b.key) & (a.index > b.index));
}

// Makes a step inside a vector: lanes with bit `stride` are the higher positions of their pairs.
inline wt_vector wt_step(wt_vector v, wt_vector partner, int stride) {
  const int16 lane = (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  return wt_choose(v, partner, wt_lanes_after(v, partner) ^ ((lane & stride) != 0));
}

inline wt_vector wt_merge2(wt_vector v) { return wt_step(v, WT_REARRANGED(v, s1032547698badcfe), 1); }
inline wt_vector wt_merge4(wt_vector v) { return wt_merge2(wt_step(v, WT_REARRANGED(v, s23016745ab89efcd), 2)); }
inline wt_vector wt_merge8(wt_vector v) { return wt_merge4(wt_step(v, WT_REARRANGED(v, s45670123cdef89ab), 4)); }
inline wt_vector wt_merge16(wt_vector v) { return wt_merge8(wt_step(v, WT_REARRANGED(v, s89abcdef01234567), 8)); }

inline wt_vector wt_sort16(wt_vector v) {
  v = wt_merge2(v);
  v = wt_merge2(wt_step(v, WT_REARRANGED(v, s32107654ba98fedc), 2));
  v = wt_merge4(wt_step(v, WT_REARRANGED(v, s76543210fedcba98), 4));
  return wt_merge8(wt_step(v, WT_REARRANGED(v, sfedcba9876543210), 8));
}

// As above, for strides of 16 at least. Keys after n, up to a whole vector, are infinite.
inline void wt_merge(local wt_key* keys, local uint* index, uint n, uint stride, uint mask) {
  for (; stride >= 16; stride /= 2, mask = stride) {
    const bool flip = mask != stride;
    for (uint c = 0; wt_low(c, stride) < n; c += 16) {
      const uint low = wt_low(c, stride), high = (low ^ mask) & ~15u;
      if (high >= n) continue;
      const wt_vector a = wt_load(keys, index, low);
      wt_vector b = wt_load(keys, index, high);
      if (flip) b = WT_REARRANGED(b, sfedcba9876543210);
      const int16 after = wt_lanes_after(a, b);
      wt_store(wt_choose(a, b, after), keys, index, low);
      b = wt_choose(b, a, after);
      if (flip) b = WT_REARRANGED(b, sfedcba9876543210);
      wt_store(b, keys, index, high);
    }
  }
  for (uint i = 0; i < n; i += 16) wt_store(wt_merge16(wt_load(keys, index, i)), keys, index, i);
}

inline void wt_sort(local wt_key* keys, local uint* index, uint n) {
  for (uint i = 0; i < n; i += 16) wt_store(wt_sort16(wt_load(keys, index, i)), keys, index, i);
  for (uint stride = 16; stride < n; stride *= 2) wt_merge(keys, index, n, stride, 2 * stride - 1);
}
#endif

// Sorts one block per work-group. If there is one block, the sort ends here. If there are several, the indices go to
// `index` (`values` if the payload is the indices), and the values, if any, are saved behind them.
kernel void sort_blocks(global wt_key* keys, global uint* values, global uint* index, uint n) {
  local wt_key block_keys[WT_BLOCK];
  local uint block_index[WT_PAYLOAD != 0 ? WT_BLOCK : 1];
  local uint unsorted;  // start of the largest keys that end the block: they are in their places
  const uint first = get_group_id(0) * WT_BLOCK, count = min(n - first, (uint)WT_BLOCK);
  const uint lane = get_local_id(0), lanes = get_local_size(0);
  if (lane == 0) unsorted = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint last = 0;
  for (uint i = lane; i < (count + WT_LANES - 1) / WT_LANES * WT_LANES; i += lanes) {
    block_keys[i] = i < count ? keys[first + i] : ~(wt_key)0;
    if (block_keys[i] != ~(wt_key)0) last = i + 1;
    if (WT_PAYLOAD != 0) block_index[i] = i < count ? first + i : ~0u;
  }
  if (last != 0) atomic_max(&unsorted, last);
  barrier(CLK_LOCAL_MEM_FENCE);
  wt_sort(block_keys, block_index, unsorted);
  for (uint i = lane; i < count; i += lanes) {
    keys[first + i] = block_keys[i];
    if (WT_PAYLOAD == 1 && n <= WT_BLOCK) block_index[i] = values[block_index[i]];
    if (WT_PAYLOAD == 1 && n > WT_BLOCK) index[(size_t)n + first + i] = values[first + i];
  }
  barrier(CLK_GLOBAL_MEM_FENCE);
  for (uint i = lane; WT_PAYLOAD != 0 && i < count; i += lanes) {
    if (WT_PAYLOAD == 1 && n <= WT_BLOCK) {
      values[i] = block_index[i];
    } else {
      index[first + i] = block_index[i];
    }
  }
}

// Makes one step over all keys, one comparator per work-item.
kernel void one_step(global wt_key* keys, global uint* index, uint n, uint stride, uint mask) {
  const uint low = wt_low(get_global_id(0), stride), high = low ^ mask;
  if (high < n) wt_compare_global(keys, index, low, high);
}

// Makes the steps of a merge that stay inside blocks, one block per work-group.
kernel void merge_blocks(global wt_key* keys, global uint* index, uint n) {
  local wt_key block_keys[WT_BLOCK];
  local uint block_index[WT_PAYLOAD != 0 ? WT_BLOCK : 1];
  const uint first = get_group_id(0) * WT_BLOCK, count = min(n - first, (uint)WT_BLOCK);
  const uint lane = get_local_id(0), lanes = get_local_size(0);
  for (uint i = lane; i < (count + WT_LANES - 1) / WT_LANES * WT_LANES; i += lanes) {
    block_keys[i] = i < count ? keys[first + i] : ~(wt_key)0;
    if (WT_PAYLOAD != 0) block_index[i] = i < count ? index[first + i] : ~0u;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  wt_merge(block_keys, block_index, count, WT_BLOCK / 2, WT_BLOCK / 2);
  for (uint i = lane; i < count; i += lanes) {
    keys[first + i] = block_keys[i];
    if (WT_PAYLOAD != 0) index[first + i] = block_index[i];
  }
}

// Moves the values that sort_blocks saved to the places of their keys.
kernel void gather(global uint* values, const global uint* index, uint n) {
  const uint i = get_global_id(0);
  if (i < n) values[i] = index[(size_t)n + index[i]];
}
