// SPDX-License-Identifier: Apache-2.0
// scan: exclusive prefix sums of counts in place, and their total: reduce, then scan (D. Merrill, M. Garland, "Single-
// pass parallel prefix scan with decoupled look-back", NVIDIA 2016, section 2), which needs no progress between groups.
// Each group has one chunk, a multiple of its tile of 4 * WT_SCAN_ITEMS counts. A single chunk needs no sums.
#include "lib/group_scan.clh"

// Returns the sum of `value` over the work-items before this one; *sum becomes the sum over all.
inline uint wt_scan_items(local uint* sums, uint value, uint* sum) {
  const uint lane = get_local_id(0);
  sums[lane] = value;
  const uint before = wt_group_scan(sums, lane, WT_SCAN_ITEMS);
  *sum = sums[WT_SCAN_ITEMS - 1];
  barrier(CLK_LOCAL_MEM_FENCE);  // the caller may use sums again
  return before;
}

// Sets sums[g] to the sum of chunk g.
__attribute__((reqd_work_group_size(WT_SCAN_ITEMS, 1, 1))) kernel void scan_sums(const global uint* restrict counts,
                                                                                 uint count, uint chunk,
                                                                                 global uint* restrict sums) {
  local uint item_sums[WT_SCAN_ITEMS];
  const uint group = get_group_id(0), first = group * chunk, length = min(chunk, count - first);
  uint item_sum = 0, sum;
  for (uint i = get_local_id(0); i < length; i += WT_SCAN_ITEMS) item_sum += counts[first + i];
  wt_scan_items(item_sums, item_sum, &sum);
  if (get_local_id(0) == 0) sums[group] = sum;
}

// Scans chunk g, tile by tile, from the sum of the chunks before it. The last group writes the total.
__attribute__((reqd_work_group_size(WT_SCAN_ITEMS, 1, 1))) kernel void scan(global uint* restrict counts, uint count,
                                                                            uint chunk,
                                                                            const global uint* restrict sums,
                                                                            global uint* restrict total) {
  local uint item_sums[WT_SCAN_ITEMS];
  const uint group = get_group_id(0), first = group * chunk, length = min(chunk, count - first);
  const uint lane = get_local_id(0);
  uint item_sum = 0, running;
  for (uint g = lane; g < group; g += WT_SCAN_ITEMS) item_sum += sums[g];
  wt_scan_items(item_sums, item_sum, &running);
  for (uint tile = 0; tile < length; tile += 4 * WT_SCAN_ITEMS) {
    global uint* own = counts + first + tile + 4 * lane;
    const uint left = length - tile, end = left - min(left, 4 * lane);  // counts from here to the chunk's end
    uint4 value = (uint4)(0);
    if (end >= 4) {
      value = vload4(0, own);
    } else if (end != 0) {
      value = (uint4)(own[0], end > 1 ? own[1] : 0u, end > 2 ? own[2] : 0u, 0u);
    }
    const uint4 before = (uint4)(0, value.x, value.x + value.y, value.x + value.y + value.z);
    uint sum;
    const uint4 out = before + running + wt_scan_items(item_sums, before.w + value.w, &sum);
    if (end >= 4) {
      vstore4(out, 0, own);
    } else if (end != 0) {
      own[0] = out.x;
      if (end > 1) own[1] = out.y;
      if (end > 2) own[2] = out.z;
    }
    running += sum;
  }
  if (lane == 0 && group == get_num_groups(0) - 1) total[0] = running;
}
