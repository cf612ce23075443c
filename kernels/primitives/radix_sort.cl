// SPDX-License-Identifier: Apache-2.0
// radix_sort: a stable radix sort from the least significant digit, whose passes read the keys once; the form for GPUs.
// clear, histogram (all digits of all keys, in one reading) and starts come first, then a move for each digit, and
// settle. A move adds up the counts of earlier tiles while they are made, and waits for none (lib/radix_tiles.clh).
// Build options besides those of lib/radix_tiles.clh: WT_COUNT_ITEMS in a work-group of histogram and starts (at least
// WT_DIGITS), WT_LATE_VALUES (1: values are read after the tile is ranked),
// WT_TICKETS (1: a group takes the next tile, 0: that of its number).
#include "lib/group_scan.clh"
#include "lib/radix_move.clh"
#include "lib/radix_tiles.clh"

#define WT_KEY_QUAD WT_JOIN(WT_KEY, 4)
#define WT_JOIN(a, b) WT_JOIN_(a, b)
#define WT_JOIN_(a, b) a##b
#define WT_MAX(a, b) ((a) > (b) ? (a) : (b))
#define WT_SHARED_BYTES WT_MAX(WT_COUNTER_BYTES, WT_TILE * sizeof(WT_KEY))

// Sets to 0 what histogram and the first move add to.
kernel void clear(global uint* temporary, uint n) {
  global uint* state = wt_tiles_state(temporary, n, 0);
  const size_t words = WT_HEAD + (size_t)(wt_tiles_state(temporary, n, 1) - state);
  for (size_t i = get_global_id(0); i < words; i += get_global_size(0))
    *(i < WT_HEAD ? temporary + i : state + (i - WT_HEAD)) = 0;
}

// Counts the keys with each digit of each pass. chunk: keys of a group, a multiple of 8 * WT_COUNT_ITEMS.
__attribute__((reqd_work_group_size(WT_COUNT_ITEMS, 1, 1))) kernel void histogram(const global WT_KEY* keys,
                                                                                  global uint* temporary, uint n,
                                                                                  uint chunk, uint first_bit, uint bits,
                                                                                  uint passes) {
  local uint bins[WT_PASSES * WT_DIGITS];
  const uint lane = get_local_id(0), begin = get_group_id(0) * chunk, end = begin + min(chunk, n - begin);
  for (uint b = lane; b < WT_PASSES * WT_DIGITS; b += WT_COUNT_ITEMS) bins[b] = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  // All loads come before the first count; the order of keys does not matter here.
  for (uint first = begin, left; first < end; first += min(left, 8u * WT_COUNT_ITEMS)) {
    left = end - first;
    WT_KEY key[8];
    const bool whole = left >= 8 * WT_COUNT_ITEMS;
    for (uint k = 0; k < 8; k += 4) {
      if (whole) {
        const WT_KEY_QUAD quad = ((const global WT_KEY_QUAD*)(keys + first + k * WT_COUNT_ITEMS))[lane];
        key[k] = quad.x;
        key[k + 1] = quad.y;
        key[k + 2] = quad.z;
        key[k + 3] = quad.w;
      } else {
        for (uint j = k; j < k + 4; ++j)
          key[j] = j * WT_COUNT_ITEMS + lane < left ? keys[first + j * WT_COUNT_ITEMS + lane] : 0;
      }
    }
    for (uint pass = 0; pass < passes; ++pass) {
      const uint shift = wt_pass_shift(first_bit, bits, passes, pass), mask = wt_pass_mask(bits, passes, pass);
      for (uint k = 0; k < 8; ++k)
        if (whole || k * WT_COUNT_ITEMS + lane < left)
          atomic_inc(bins + pass * WT_DIGITS + wt_radix_digit(key[k], shift, mask));
    }
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint b = lane; b < passes * WT_DIGITS; b += WT_COUNT_ITEMS)
    if (bins[b]) wt_fetch_add_u32(wt_tiles_starts(temporary, b / WT_DIGITS, 1) + b % WT_DIGITS, bins[b]);
}

// One work-group takes a pass: its counts become the places of each digit's first key in the output.
__attribute__((reqd_work_group_size(WT_COUNT_ITEMS, 1, 1))) kernel void starts(global uint* temporary, uint n) {
  local uint sums[WT_DIGITS];
  local uint constant_digit;
  const uint lane = get_local_id(0), pass = get_group_id(0);
  if (lane == 0) constant_digit = 0;
  if (lane < WT_DIGITS) sums[lane] = wt_tiles_starts(temporary, pass, 1)[lane];
  const uint start = wt_group_scan(sums, lane, WT_DIGITS);
  if (lane < WT_DIGITS) wt_tiles_starts(temporary, pass, 0)[lane] = start;
  if (lane < WT_DIGITS && wt_tiles_starts(temporary, pass, 1)[lane] == n) constant_digit = 1;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lane == 0) wt_radix_constant(temporary)[pass] = constant_digit;
}

// Moves every key of a tile, and its value, to the place of its digit. first_tile: the first one of this launch. turn:
// the row of starts of this launch, 0 or 1; its last tile writes the other one, for the next launch of the pass.
__attribute__((reqd_work_group_size(WT_ITEMS, 1, 1))) kernel void move(global WT_KEY* keys, global uint* values,
                                                                       global uint* temporary, uint n, uint pass,
                                                                       uint shift, uint digit_mask, uint first_tile,
                                                                       uint turn) {
  local ulong shared[(WT_SHARED_BYTES + 7) / 8];  // counters come first, then the tile in its new order: keys, values
  local uint rank_words[WT_RANK_WORDS], targets[WT_DIGITS], sums[WT_DIGITS], taken, stuck;
  local uint* counters = (local uint*)shared;
  local WT_KEY* sorted_keys = (local WT_KEY*)shared;
  local uint* sorted_values = (local uint*)shared;

  const uint lane = get_local_id(0);
  if (lane == 0) {  // before the flags are read, since both take long; a pass that moves nothing needs no tickets
    if (WT_TICKETS) taken = wt_fetch_add_u32(wt_tiles_ticket(temporary, pass), 1u);
    stuck = 0;
  }
  if (wt_radix_constant(temporary)[pass]) return;
  const uint moves = wt_radix_moves(wt_radix_constant(temporary), pass);
  barrier(CLK_LOCAL_MEM_FENCE);
  const bool back = moves & 1;
  const uint tile = WT_TICKETS ? taken : first_tile + (uint)get_group_id(0), first = tile * WT_TILE,
             size = min((uint)WT_TILE, n - first);
  const bool last = tile + 1 == first_tile + get_num_groups(0);
  const wt_tile t = {back ? wt_tiles_keys(temporary) : keys,
                     wt_tiles_state(temporary, n, back),
                     wt_tiles_starts(temporary, pass, turn),
                     last ? wt_tiles_starts(temporary, pass, 1 - turn) : 0,
                     lane,
                     tile,
                     first_tile,
                     shift,
                     digit_mask};
  const global uint* value_source = (back ? wt_tiles_values(temporary, n) : values) + first;
  WT_KEY key[WT_KEYS_AN_ITEM];
  uint value[WT_KEYS_AN_ITEM], places[WT_PLACE_WORDS];
  wt_read_keys(t.source + first, key, lane, size);
  if (WT_PAYLOAD && !WT_LATE_VALUES) wt_read_values(value_source, value, lane, size, first, moves > 0);
  global uint* next_state = wt_tiles_state(temporary, n, !back) + (size_t)tile * WT_DIGITS;
  for (uint d = lane; d < WT_DIGITS; d += WT_ITEMS) next_state[d] = 0;

  wt_item_digits digits;
  wt_count_tile(counters, rank_words, key, lane, shift, digit_mask);
  barrier(CLK_LOCAL_MEM_FENCE);
  wt_start_tile(&t, &digits, counters, sums);
  barrier(CLK_LOCAL_MEM_FENCE);
  wt_rank_tile(counters, rank_words, key, places, lane, wt_anew(shift), digit_mask);
  barrier(CLK_LOCAL_MEM_FENCE);
#pragma unroll
  for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k) sorted_keys[wt_place(places, k)] = key[k];
  if (WT_PAYLOAD && WT_LATE_VALUES) wt_read_values(value_source, value, lane, size, first, moves > 0);
  wt_find_targets(&t, &digits, targets, sums, &stuck);

  global WT_KEY* target = back ? keys : wt_tiles_keys(temporary);
  uint digit_of[(WT_KEYS_AN_ITEM + 3) / 4];  // a byte for each sorted key
  if (size == WT_TILE) {
#pragma unroll
    for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k)
      wt_write_key(target, sorted_keys, targets, digit_of, k * WT_ITEMS + lane, k, shift, digit_mask);
  } else {
#pragma unroll
    for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k)
      if (k * WT_ITEMS + lane < size)
        wt_write_key(target, sorted_keys, targets, digit_of, k * WT_ITEMS + lane, k, shift, digit_mask);
  }
  if (WT_PAYLOAD == 0) return;
  barrier(CLK_LOCAL_MEM_FENCE);
#pragma unroll
  for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k) sorted_values[wt_place(places, k)] = value[k];
  barrier(CLK_LOCAL_MEM_FENCE);
  global uint* value_target = back ? values : wt_tiles_values(temporary, n);
  if (size == WT_TILE) {
#pragma unroll
    for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k)
      wt_write_value(value_target, sorted_values, targets, digit_of, k * WT_ITEMS + lane, k);
  } else {
#pragma unroll
    for (uint k = 0; k < WT_KEYS_AN_ITEM; ++k)
      if (k * WT_ITEMS + lane < size)
        wt_write_value(value_target, sorted_values, targets, digit_of, k * WT_ITEMS + lane, k);
  }
}

// After an odd number of moves, brings keys and values back to the caller's memory.
kernel void settle(global WT_KEY* keys, global uint* values, global uint* temporary, uint n, uint passes) {
  const uint moves = wt_radix_moves(wt_radix_constant(temporary), passes);
  const global WT_KEY* other_keys = wt_tiles_keys(temporary);
  if ((moves & 1) == 0 && (WT_PAYLOAD != 2 || moves > 0)) return;
  for (size_t i = get_global_id(0); i < n; i += get_global_size(0)) {
    if (moves & 1) keys[i] = other_keys[i];
#if WT_PAYLOAD
    if (moves & 1) values[i] = wt_tiles_values(temporary, n)[i];
#endif
#if WT_PAYLOAD == 2
    if (moves == 0) values[i] = (uint)i;
#endif
  }
}
