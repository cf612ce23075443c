// SPDX-License-Identifier: Apache-2.0
// compact: lists, in order, the indices of the words planes[first .. first + count - 1] that are not WT_NONE. Consumes
// the counts of count_blocks after they are scanned. Words come in blocks of WT_BLOCK. With WT_BLOCKS_PER_ITEM (CPUs) a
// work-item takes that many blocks in turn, without it a work-group takes one.
#include "lib/hit.clh"

#ifdef WT_BLOCKS_PER_ITEM
kernel void count_blocks(const global float* planes, ulong first, uint count, global uint* block_counts) {
  const global float* words = planes + first;
  for (uint b = 0; b < WT_BLOCKS_PER_ITEM; ++b) {
    const ulong block = get_global_id(0) * WT_BLOCKS_PER_ITEM + b, start = block * WT_BLOCK;
    if (start >= count) return;
    const uint end = (uint)min(start + WT_BLOCK, (ulong)count);
    uint alive = 0;
    for (uint i = (uint)start; i < end; ++i) alive += as_uint(words[i]) != WT_NONE;
    block_counts[block] = alive;
  }
}

kernel void compact(const global float* planes, ulong first, uint count, const global uint* block_offsets,
                    global uint* indices) {
  const global float* words = planes + first;
  const ulong first_block = get_global_id(0) * WT_BLOCKS_PER_ITEM, start = first_block * WT_BLOCK;
  if (start >= count) return;
  uint j = block_offsets[first_block];
  for (uint b = 0; b < WT_BLOCKS_PER_ITEM && start + b * WT_BLOCK < count; ++b) {
    // The list is written without branches, since half of them would be mispredicted.
    const uint block_start = (uint)start + b * WT_BLOCK, size = min((uint)WT_BLOCK, count - block_start);
    uint list[WT_BLOCK], alive = 0;
    for (uint k = 0; k < size; ++k) {
      list[alive] = block_start + k;
      alive += as_uint(words[block_start + k]) != WT_NONE;
    }
    for (uint k = 0; k < alive; ++k) indices[j + k] = list[k];
    j += alive;
  }
}
#else
#include "lib/block_rank.clh"

__attribute__((reqd_work_group_size(WT_BLOCK, 1, 1))) kernel void count_blocks(const global float* planes, ulong first,
                                                                               uint count, global uint* block_counts) {
  local uint masks[WT_BLOCK_MASKS];
  const size_t i = get_global_id(0);
  wt_mark_block(masks, i < count && as_uint(planes[first + i]) != WT_NONE);
  if (get_local_id(0) == 0) block_counts[get_group_id(0)] = wt_block_count(masks);
}

__attribute__((reqd_work_group_size(WT_BLOCK, 1, 1))) kernel void compact(const global float* planes, ulong first,
                                                                          uint count, const global uint* block_offsets,
                                                                          global uint* indices) {
  local uint masks[WT_BLOCK_MASKS];
  const size_t i = get_global_id(0);
  const bool lives = i < count && as_uint(planes[first + i]) != WT_NONE;
  wt_mark_block(masks, lives);
  if (lives) indices[block_offsets[get_group_id(0)] + wt_block_rank(masks)] = (uint)i;
}
#endif
