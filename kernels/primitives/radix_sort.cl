// SPDX-License-Identifier: Apache-2.0
// radix_sort: a stable radix sort from the least significant digit, reduce then scan; the form for GPUs. Each pass is
// count, offsets, move; settle follows the last. No work-group waits for another, so no forward progress is assumed.
// Build options besides those of lib/radix.clh: WT_ITEMS in a work-group (at least WT_DIGITS), WT_OFFSET_ITEMS in one
// of offsets, WT_TILE keys that a group moves, WT_COLUMNS of a tile, WT_TOGETHER (1: a tile's values lie in local
// memory beside its keys, else after them), WT_LATE_VALUES (1: values are read after the tile is ranked). Chunks are
// whole tiles.
#include "lib/group_scan.clh"
#include "lib/radix.clh"

#define WT_KEYS_AN_ITEM (WT_TILE / WT_ITEMS)
#define WT_COLUMN_KEYS (WT_TILE / WT_COLUMNS)
// Rows of counters and columns of digits are padded by one word, so that lanes do not all meet in one bank.
#define WT_ROW (WT_COLUMNS + 2)
#define WT_DIGIT_STRIDE (WT_COLUMN_KEYS + 4)
#define WT_KEY_PAIR WT_JOIN(WT_KEY, 2)
#define WT_JOIN(a, b) WT_JOIN_(a, b)
#define WT_JOIN_(a, b) a##b
#define WT_MAX(a, b) ((a) > (b) ? (a) : (b))

// Counts the keys of each chunk with each digit and, for every tile, those of its chunk before the tile.
__attribute__((reqd_work_group_size(WT_ITEMS, 1, 1))) kernel void count(const global WT_KEY* keys,
                                                                        global uint* temporary, uint n, uint chunk,
                                                                        uint pass, uint shift, uint digit_mask) {
  local uint bins[WT_DIGITS];
  const uint lane = get_local_id(0), group = get_group_id(0), chunks = get_num_groups(0);
  if (get_global_id(0) == 0) wt_radix_constant(temporary)[pass] = 0;
  const global WT_KEY* source =
      wt_radix_moves(wt_radix_constant(temporary), pass) & 1 ? wt_radix_keys(temporary, chunks) : keys;
  global uint* earlier = wt_radix_earlier(temporary, chunks, n);
  if (lane < WT_DIGITS) bins[lane] = 0;
  const uint chunk_first = group * chunk, chunk_end = chunk_first + min(chunk, n - chunk_first);
  for (uint first = chunk_first, size; first < chunk_end; first += size) {
    size = min((uint)WT_TILE, chunk_end - first);
    // All loads come before the first count; in whole tiles they are pairs of neighbours, whose order does not matter
    // here.
    WT_KEY key[WT_KEYS_AN_ITEM];
    const bool whole = size == WT_TILE;
    if (WT_KEYS_AN_ITEM % 2 == 1) {
      const uint p = (WT_KEYS_AN_ITEM - 1) * WT_ITEMS + lane;
      key[WT_KEYS_AN_ITEM - 1] = p < size ? source[first + p] : 0;
    }
    for (uint k = 0; k + 1 < WT_KEYS_AN_ITEM; k += 2) {
      const uint p = k * WT_ITEMS + lane;
      if (whole) {
        const WT_KEY_PAIR pair = ((const global WT_KEY_PAIR*)(source + first + k * WT_ITEMS))[lane];
        key[k] = pair.x;
        key[k + 1] = pair.y;
      } else {
        key[k] = p < size ? source[first + p] : 0;
        key[k + 1] = p + WT_ITEMS < size ? source[first + p + WT_ITEMS] : 0;
      }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lane < WT_DIGITS) earlier[(size_t)(first / WT_TILE) * WT_DIGITS + lane] = bins[lane];
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k)
      if (whole || k * WT_ITEMS + lane < size) atomic_inc(bins + wt_radix_digit(key[k], shift, digit_mask));
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lane < WT_DIGITS) wt_radix_counts(temporary)[(size_t)lane * chunks + group] = bins[lane];
}

// One work-group takes a digit: its counts become the numbers of keys with that digit in earlier chunks.
__attribute__((reqd_work_group_size(WT_OFFSET_ITEMS, 1, 1))) kernel void offsets(global uint* temporary, uint n,
                                                                                 uint chunk, uint pass) {
  local uint sums[WT_OFFSET_ITEMS];
  const uint lane = get_local_id(0), digit = get_group_id(0), chunks = (n - 1) / chunk + 1;
  global uint* row = wt_radix_counts(temporary) + (size_t)digit * chunks;
  const uint part = (chunks + WT_OFFSET_ITEMS - 1) / WT_OFFSET_ITEMS;
  const uint first = min(lane * part, chunks), end = min(first + part, chunks);
  uint sum = 0;
  for (uint c = first; c < end; ++c) sum += row[c];
  sums[lane] = sum;
  uint running = wt_group_scan(sums, lane, WT_OFFSET_ITEMS);
  for (uint c = first; c < end; ++c) {
    const uint count = row[c];
    row[c] = running;
    running += count;
  }
  if (lane != WT_OFFSET_ITEMS - 1) return;
  wt_radix_totals(temporary)[digit] = running;
  if (running == n) wt_radix_constant(temporary)[pass] = 1;
}

// Moves every key of a tile, and its value, to the place of its digit. The tile is ranked without atomics, because
// their order would be random: it is cut into columns of consecutive keys, one work-item counts each column's digits in
// turn, and the counts of earlier columns are added. A work-group takes one tile, so that groups that run together
// write next to each other: groups that walked through chunks of their own would write to too many places for the
// cache.
__attribute__((reqd_work_group_size(WT_ITEMS, 1, 1))) kernel void move(global WT_KEY* keys, global uint* values,
                                                                       global uint* temporary, uint n, uint chunk,
                                                                       uint pass, uint shift, uint digit_mask) {
  // Counters of the columns come first, then the tile in its new order: keys, then values.
  local ulong shared[WT_MAX(WT_DIGITS * WT_ROW * 2, WT_TILE * (sizeof(WT_KEY) + WT_TOGETHER * sizeof(uint))) / 8];
  local uint digits_of_columns[WT_COLUMNS * WT_DIGIT_STRIDE / 4];  // bytes; ranks in the column later
  local uint targets[WT_DIGITS];  // for each digit its start in the output, less its start in the sorted tile
  local uint sums[WT_DIGITS];
  local ushort* columns = (local ushort*)shared;
  local uint* column_pairs = (local uint*)shared;
  local WT_KEY* sorted_keys = (local WT_KEY*)shared;
  local uint* sorted_values = WT_TOGETHER ? (local uint*)(sorted_keys + WT_TILE) : (local uint*)shared;
  local uchar* digits = (local uchar*)digits_of_columns;

  if (wt_radix_constant(temporary)[pass]) return;
  const uint lane = get_local_id(0), tile = get_group_id(0), first = tile * WT_TILE;
  const uint size = min((uint)WT_TILE, n - first), chunks = (n - 1) / chunk + 1;
  const uint moves = wt_radix_moves(wt_radix_constant(temporary), pass);
  global WT_KEY* other_keys = wt_radix_keys(temporary, chunks);
  global uint* other_values = wt_radix_values(temporary, chunks, n);
  const global WT_KEY* source = moves & 1 ? other_keys : keys;
  global WT_KEY* target = moves & 1 ? keys : other_keys;
  const global uint* value_source = moves & 1 ? other_values : values;
  global uint* value_target = moves & 1 ? values : other_values;

  WT_KEY key[WT_KEYS_AN_ITEM];
  for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k) {
    // Padding after the last key gets the last digit and, being last, stays behind the keys.
    const uint p = k * WT_ITEMS + lane;
    key[k] = p < size ? source[first + p] : ~(WT_KEY)0;
  }
  // There are no values yet before the first move of an index.
  const bool has_values = WT_PAYLOAD == 2 ? moves > 0 : WT_PAYLOAD == 1;
  uint value[WT_KEYS_AN_ITEM];
  for (uint k = 0; !WT_LATE_VALUES && k < WT_KEYS_AN_ITEM; ++k) {
    const uint i = first + k * WT_ITEMS + lane;
    value[k] = has_values && i < n ? value_source[i] : i;
  }
  uint start_of_digit = 0;
  if (lane < WT_DIGITS) {
    sums[lane] = wt_radix_totals(temporary)[lane];
    start_of_digit = wt_radix_counts(temporary)[(size_t)lane * chunks + first / chunk] +
                     wt_radix_earlier(temporary, chunks, n)[(size_t)tile * WT_DIGITS + lane];
  }
  for (uint w = lane; w < WT_DIGITS * WT_ROW / 2; w += WT_ITEMS) column_pairs[w] = 0;
  for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k) {
    const uint p = k * WT_ITEMS + lane;
    digits[p + p / WT_COLUMN_KEYS * 4] = (uchar)wt_radix_digit(key[k], shift, digit_mask);
  }
  start_of_digit += wt_group_scan(sums, lane, WT_DIGITS);

  if (lane < WT_COLUMNS) {
    local uint* four = digits_of_columns + lane * (WT_DIGIT_STRIDE / 4);
    for (uint j = 0; j < WT_COLUMN_KEYS / 4; ++j) {
      const uint d = four[j];
      uint ranks = 0;
      for (uint b = 0; b < 32; b += 8) {
        local ushort* counter = columns + (d >> b & 255u) * WT_ROW + lane;
        const uint rank = *counter;
        *counter = (ushort)(rank + 1);
        ranks |= rank << b;
      }
      four[j] = ranks;
    }
  }
  barrier(CLK_LOCAL_MEM_FENCE);

  if (lane < WT_DIGITS) {
    const local uint* row = column_pairs + lane * (WT_ROW / 2);
    uint total = 0;
    for (uint w = 0; w < WT_COLUMNS / 2; ++w) total += row[w];
    sums[lane] = (total & 0xFFFFu) + (total >> 16);
  }
  const uint start = wt_group_scan(sums, lane, WT_DIGITS);
  if (lane < WT_DIGITS) {  // counts of a column become the place of its first key with that digit
    targets[lane] = start_of_digit - start;
    local uint* row = column_pairs + lane * (WT_ROW / 2);
    uint running = start;
    for (uint w = 0; w < WT_COLUMNS / 2; ++w) {
      const uint pair = row[w], low = pair & 0xFFFFu;
      row[w] = running | (running + low) << 16;
      running += low + (pair >> 16);
    }
  }
  barrier(CLK_LOCAL_MEM_FENCE);

  uint place[WT_KEYS_AN_ITEM];  // places in the sorted tile
  for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k) {
    const uint p = k * WT_ITEMS + lane, d = wt_radix_digit(key[k], shift, digit_mask), column = p / WT_COLUMN_KEYS;
    place[k] = columns[d * WT_ROW + column] + digits[p + column * 4];
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint k = 0; WT_LATE_VALUES && k < WT_KEYS_AN_ITEM; ++k) {
    const uint i = first + k * WT_ITEMS + lane;
    value[k] = has_values && i < n ? value_source[i] : i;
  }
  for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k) {
    sorted_keys[place[k]] = key[k];
    if (WT_TOGETHER) sorted_values[place[k]] = value[k];
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  uint to[WT_KEYS_AN_ITEM];
  for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k) {
    const uint p = k * WT_ITEMS + lane;
    const WT_KEY sorted = sorted_keys[p];
    to[k] = targets[wt_radix_digit(sorted, shift, digit_mask)] + p;
    if (p < size) target[to[k]] = sorted;
    if (WT_TOGETHER && p < size) value_target[to[k]] = sorted_values[p];
  }
  if (WT_TOGETHER || WT_PAYLOAD == 0) return;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k) sorted_values[place[k]] = value[k];
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k) {
    const uint p = k * WT_ITEMS + lane;
    if (p < size) value_target[to[k]] = sorted_values[p];
  }
}

// After an odd number of moves, brings keys and values back to the caller's memory.
__attribute__((reqd_work_group_size(WT_ITEMS, 1, 1))) kernel void settle(global WT_KEY* keys, global uint* values,
                                                                         global uint* temporary, uint n, uint chunk,
                                                                         uint passes) {
  const uint chunks = (n - 1) / chunk + 1, moves = wt_radix_moves(wt_radix_constant(temporary), passes);
  const global WT_KEY* other_keys = wt_radix_keys(temporary, chunks);
  const uint items = get_global_size(0);
  for (size_t i = get_global_id(0); i < n; i += items) {
    if (moves & 1) keys[i] = other_keys[i];
#if WT_PAYLOAD
    if (moves & 1) values[i] = wt_radix_values(temporary, chunks, n)[i];
#endif
#if WT_PAYLOAD == 2
    if (moves == 0) values[i] = (uint)i;
#endif
  }
}
