// SPDX-License-Identifier: Apache-2.0
// radix_sort: a stable radix sort from the least significant digit, reduce then scan; the form for CPUs. One
// work-item is a work-group and takes one chunk of consecutive keys. Build options besides those of lib/radix.clh:
// WT_SCATTER_KEYS, the most keys that are written one by one; more keys do not fit into any cache and go through lines.
#include "lib/radix.clh"

// A line is the memory in which the keys of one digit are collected before it is written whole, here two vectors of 64
// bytes of keys: shorter lines mispredict a branch more often, longer ones push each other out of the first-level
// cache.
#define WT_KEY_VECTORS 2u
#define WT_LINE (WT_KEY_VECTORS * 64u / (uint)sizeof(WT_KEY))
#define WT_VALUE_VECTORS (WT_LINE / 16u)

typedef struct {
  const global WT_KEY* from_keys;
  const global uint* from_values;  // values of the chunk, like from_keys
  global WT_KEY* to_keys;
  global uint* to_values;
  uint first, size;  // keys of the chunk
  bool positions;    // the values are the keys' positions
} wt_move;

// The first key of this work-item's chunk, and how many keys it has.
inline uint wt_first(uint chunk) { return (uint)get_group_id(0) * chunk; }
inline uint wt_size(uint chunk, uint n) { return min(chunk, n - wt_first(chunk)); }

inline uint wt_value(const private wt_move* m, uint i) { return m->positions ? m->first + i : m->from_values[i]; }

// Counts the keys of each chunk with each digit.
kernel void count(const global WT_KEY* keys, global uint* temporary, uint n, uint chunk, uint pass, uint shift,
                  uint digit_mask) {
  const uint chunks = get_num_groups(0), first = wt_first(chunk), size = wt_size(chunk, n);
  if (first == 0) wt_radix_constant(temporary)[pass] = 0;
  const uint moves = wt_radix_moves(wt_radix_constant(temporary), pass);
  const global WT_KEY* from = (moves & 1 ? wt_radix_keys(temporary, chunks) : keys) + first;
  uint bins[WT_DIGITS];
  for (uint d = 0; d < WT_DIGITS; ++d) bins[d] = 0;
  for (uint i = 0; i < size; ++i) ++bins[wt_radix_digit(from[i], shift, digit_mask)];
  global uint* counts = wt_radix_counts(temporary) + get_group_id(0);
  for (uint d = 0; d < WT_DIGITS; ++d) counts[(size_t)d * chunks] = bins[d];
}

// One work-item makes of each digit's counts the numbers of keys with that digit in earlier chunks.
kernel void offsets(global uint* temporary, uint n, uint chunk, uint pass) {
  const uint chunks = (n - 1) / chunk + 1;
  global uint* counts = wt_radix_counts(temporary);
  for (uint d = 0; d < WT_DIGITS; ++d) {
    uint running = 0;
    for (uint c = 0; c < chunks; ++c) {
      const uint count = counts[(size_t)d * chunks + c];
      counts[(size_t)d * chunks + c] = running;
      running += count;
    }
    wt_radix_totals(temporary)[d] = running;
    if (running == n) wt_radix_constant(temporary)[pass] = 1;
  }
}

// Writes each key where it belongs. next: the place of the next key of each digit.
inline void wt_move_keys(const private wt_move* m, private uint* next, uint shift, uint digit_mask) {
  for (uint i = 0; i < m->size; ++i) {
    const WT_KEY key = m->from_keys[i];
    const uint to = next[wt_radix_digit(key, shift, digit_mask)]++;
    m->to_keys[to] = key;
    if (WT_PAYLOAD) m->to_values[to] = wt_value(m, i);
  }
}

// A store that bypasses the caches, which have neither the line nor room for it. PoCL ends a kernel with locked
// instructions, which on x86 also order these stores (Intel SDM vol. 1, 10.4.6.2).
inline void wt_store_vector(global uint16* to, const private uint16* from) {
#if defined(WT_CPU) && defined(__has_builtin)
#if __has_builtin(__builtin_nontemporal_store)
  __builtin_nontemporal_store(*from, to);
  return;
#endif
#endif
  *to = *from;
}

// Writes the keys [from, to) of one digit, which lie in one line.
inline void wt_write_part(const private wt_move* m, const private WT_KEY* keys, const private uint* values, uint from,
                          uint to) {
  for (uint i = from; i < to; ++i) {
    m->to_keys[i] = keys[i % WT_LINE];
    if (WT_PAYLOAD) m->to_values[i] = values[i % WT_LINE];
  }
}

// The same through lines (write combining): Satish et al., "Fast sort on CPUs and GPUs", SIGMOD 2010, section 3.1. A
// full line is written when the next key of its digit comes: by then its last stores have left the store buffer, from
// which a vector cannot be read.
inline void wt_move_lines(const private wt_move* m, private uint* next, uint shift, uint digit_mask) {
  uint16 key_vectors[WT_DIGITS * WT_KEY_VECTORS], value_vectors[WT_PAYLOAD ? WT_DIGITS * WT_VALUE_VECTORS : 1];
 private
  WT_KEY* keys = (private WT_KEY*)key_vectors;
 private
  uint* values = (private uint*)value_vectors;
  uint start[WT_DIGITS];
  for (uint d = 0; d < WT_DIGITS; ++d) start[d] = next[d];
  for (uint i = 0; i < m->size; ++i) {
    const WT_KEY key = m->from_keys[i];
    const uint d = wt_radix_digit(key, shift, digit_mask), to = next[d]++;
    if (to % WT_LINE == 0) {
      const uint line = to - WT_LINE;
      if (to >= WT_LINE && line >= start[d]) {
        for (uint v = 0; v < WT_KEY_VECTORS; ++v)
          wt_store_vector((global uint16*)(m->to_keys + line) + v, key_vectors + d * WT_KEY_VECTORS + v);
        for (uint v = 0; WT_PAYLOAD && v < WT_VALUE_VECTORS; ++v)
          wt_store_vector((global uint16*)(m->to_values + line) + v, value_vectors + d * WT_VALUE_VECTORS + v);
      } else {
        wt_write_part(m, keys + d * WT_LINE, values + d * WT_LINE, start[d], to);
      }
    }
    keys[d * WT_LINE + to % WT_LINE] = key;
    if (WT_PAYLOAD) values[d * WT_LINE + to % WT_LINE] = wt_value(m, i);
  }
  for (uint d = 0; d < WT_DIGITS; ++d) {
    if (next[d] == start[d]) continue;
    const uint line = (next[d] - 1) / WT_LINE * WT_LINE;
    wt_write_part(m, keys + d * WT_LINE, values + d * WT_LINE, max(line, start[d]), next[d]);
  }
}

// Moves every key, and its value, to the place of its digit.
kernel void move(global WT_KEY* keys, global uint* values, global uint* temporary, uint n, uint chunk, uint pass,
                 uint shift, uint digit_mask) {
  if (wt_radix_constant(temporary)[pass]) return;
  const uint chunks = get_num_groups(0);
  const uint moves = wt_radix_moves(wt_radix_constant(temporary), pass);
  global WT_KEY* other_keys = wt_radix_keys(temporary, chunks);
  global uint* other_values = wt_radix_values(temporary, chunks, n);
  wt_move m;
  m.first = wt_first(chunk);
  m.size = wt_size(chunk, n);
  m.from_keys = (moves & 1 ? other_keys : keys) + m.first;
  m.from_values = (moves & 1 ? other_values : values) + m.first;
  m.to_keys = moves & 1 ? keys : other_keys;
  m.to_values = moves & 1 ? values : other_values;
  m.positions = WT_PAYLOAD == 2 && moves == 0;
  const global uint* counts = wt_radix_counts(temporary) + get_group_id(0);
  uint next[WT_DIGITS];
  uint lower = 0;  // keys with lower digits
  for (uint d = 0; d < WT_DIGITS; ++d) {
    next[d] = lower + counts[(size_t)d * chunks];
    lower += wt_radix_totals(temporary)[d];
  }
  if (n <= WT_SCATTER_KEYS)
    wt_move_keys(&m, next, shift, digit_mask);
  else
    wt_move_lines(&m, next, shift, digit_mask);
}

// After the last pass, copies keys and values to the caller's buffers; values are positions where nothing has moved.
kernel void settle(global WT_KEY* keys, global uint* values, global uint* temporary, uint n, uint chunk, uint passes) {
  const uint chunks = get_num_groups(0), first = wt_first(chunk), end = first + wt_size(chunk, n);
  const uint moves = wt_radix_moves(wt_radix_constant(temporary), passes);
  if (WT_PAYLOAD == 2 && moves == 0) {
    for (uint i = first; i < end; ++i) values[i] = i;
  }
  if ((moves & 1) == 0) return;
  const global WT_KEY* other_keys = wt_radix_keys(temporary, chunks);
  const global uint* other_values = wt_radix_values(temporary, chunks, n);
  for (uint i = first; i < end; ++i) {
    keys[i] = other_keys[i];
    if (WT_PAYLOAD) values[i] = other_values[i];
  }
}
