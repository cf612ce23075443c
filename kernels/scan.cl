// scan: exclusive prefix sums of block counts in place, by one work-group; total[0] becomes the sum of all.
// For the few hundred thousand blocks of a batch; WT_SCAN_ITEMS work-items (1 on CPUs), each over a contiguous part.

__attribute__((reqd_work_group_size(WT_SCAN_ITEMS, 1, 1))) kernel void scan(global uint* counts, uint count,
                                                                            global uint* total) {
  local uint sums[WT_SCAN_ITEMS];
  const uint lane = get_local_id(0);
  const uint part = (count + WT_SCAN_ITEMS - 1) / WT_SCAN_ITEMS;
  const uint first = min(lane * part, count), end = min(first + part, count);
  uint sum = 0;
  for (uint i = first; i < end; ++i) sum += counts[i];
  sums[lane] = sum;
  barrier(CLK_LOCAL_MEM_FENCE);
  // Hillis and Steele, "Data parallel algorithms", CACM 29(12), 1986.
  for (uint step = 1; step < WT_SCAN_ITEMS; step *= 2) {
    const uint before = lane >= step ? sums[lane - step] : 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    sums[lane] += before;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (lane == WT_SCAN_ITEMS - 1) total[0] = sums[lane];
  uint running = sums[lane] - sum;
  for (uint i = first; i < end; ++i) {
    const uint value = counts[i];
    counts[i] = running;
    running += value;
  }
}
