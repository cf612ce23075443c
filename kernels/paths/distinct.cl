// SPDX-License-Identifier: Apache-2.0
// distinct: the rows of a frame's paths, each path once, in the order of links and delays. Consumes visible paths and,
// where links have one the other way, adds each path's reversed twin. A row is only a number
// (wavetracer/device/path_rows.h); nothing is copied. Keys with a coarse length bring the rows of a link together; then
// neighbours are compared exactly.
#include "lib/count.clh"
#include "lib/prefetch_path.clh"
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/path_along.h"
#pragma OPENCL FP_CONTRACT OFF

// The key of a link and a length, monotonic in both. It distinguishes lengths by their exponents from 2^-4 to 2^27 m
// and by as much of the mantissa as fits into the key.
inline uint row_key(wt_distinct_arguments args, uint link, double length_m) {
  const uint bits = as_uint((float)fmin(fmax(length_m, 0.0625), 1.3e8)) - (123u << 23);
  return link << args.length_bits | bits >> (28u - args.length_bits);
}

// Row 2 i is visible path i, row 2 i + 1 its twin. links: those that are wanted; own: those that are kept, a bit each.
// A number without a row gets the largest key.
kernel void row_keys(const global wt_solved* solved, const global double* vertices, const global uint* steps,
                     const global double* transmitters, const global double* receivers, const global uint* receiver_of,
                     const global uint* transmitter_of, const global ushort* links, const global ushort* own,
                     global uint* keys, global double* lengths, const global wt_counters* counters,
                     wt_distinct_arguments args) {
  const uint item = get_global_id(0);
  if (item >= args.row_count) return;
  const uint row = args.twins ? item : 2 * item;
  keys[item] = WT_NONE;
  if (row / 2 >= wt_length(counters, args.visible_counter, args.row_count)) return;
  const wt_path_list list = {solved,    vertices,    steps,          transmitters,
                             receivers, receiver_of, transmitter_of, args.max_depth};
  if (row & 1u) {
    const uint tx = transmitter_of[solved[row / 2].receiver], rx = receiver_of[solved[row / 2].transmitter];
    if (tx == WT_NONE || rx == WT_NONE || !(links[tx * args.groups + rx / 16] >> rx % 16 & 1u)) return;
  }
  const wt_path path = wt_path_of(&list, row);
  if (!(own[path.transmitter * args.groups + path.receiver / 16] >> path.receiver % 16 & 1u)) return;
  const double length_m = wt_path_length(&path);
  lengths[item] = length_m;
  keys[item] = row_key(args, path.transmitter * args.receiver_count + path.receiver, length_m);
}

// Begins to read the row at a place, if there is one. order, keys, lengths: see mark_rows.
inline void prefetch_row(const wt_path_list* list, const global uint* keys, const global uint* order,
                         const global double* lengths, uint place, wt_distinct_arguments args) {
  if (WT_AHEAD == 1 || place >= args.row_count || keys[place] == WT_NONE) return;
  wt_prefetch(lengths + order[place]);
  wt_prefetch_path(list, (args.twins ? 1u : 2u) * order[place]);
}

// Marks the row at each sorted place: WT_ROW_STAYS, WT_ROW_IS_NEAR (an antenna touches the surface that reflects
// there), or 0 where another row is the same path or one of which it is a part (path_along.h). The row that stays gets
// the quarters of the others, too. wedges: may be null.
kernel void mark_rows(const global wt_solved* solved, const global double* vertices, const global uint* steps,
                      const global double* transmitters, const global double* receivers, const global uint* receiver_of,
                      const global uint* transmitter_of, const global wt_exact_surface* surfaces,
                      const global wt_wedge* wedges, const global uint* keys, const global uint* order,
                      const global double* lengths, global uchar* stays, global uchar* quarters,
                      global wt_counters* counters, wt_distinct_arguments args) {
  const uint place = get_global_id(0);
  if (place >= args.row_count) return;
  stays[place] = 0;
  if (keys[place] == WT_NONE) return;
  const wt_path_list list = {solved,    vertices,    steps,          transmitters,
                             receivers, receiver_of, transmitter_of, args.max_depth};
  prefetch_row(&list, keys, order, lengths, place + WT_AHEAD, args);
  const uint scale = args.twins ? 1u : 2u, row = scale * order[place];
  const wt_path path = wt_path_of(&list, row);
  const double length_m = lengths[order[place]];
  // Vertices that are WT_MERGE_M apart along each axis change a length by twice that times sqrt 3, each.
  const double apart_m = 4.0 * WT_MERGE_M * path.depth + 1e-6;
  const uint link = path.transmitter * args.receiver_count + path.receiver;
  const double most_m = apart_m + WT_ALONG_LENGTH_M;
  const uint lowest = row_key(args, link, length_m - most_m), highest = row_key(args, link, length_m + most_m);
  wt_field_world world;
  world.surfaces = surfaces;
  world.wedges = wedges;
  uint found = solved[row / 2].quarters;
  for (int way = -1; way <= 1; way += 2)
    for (uint i = place + way; i < args.row_count && keys[i] >= lowest && keys[i] <= highest; i += way) {
      const uint other_row = scale * order[i];
      const uint depth = solved[other_row / 2].depth;
      if (depth < path.depth || !(fabs(lengths[order[i]] - length_m) <= most_m)) continue;
      const wt_path other = wt_path_of(&list, other_row);
      if (wedges && wt_is_along(&world, &path, length_m, &other, lengths[order[i]])) return;
      if (depth != path.depth || !(fabs(lengths[order[i]] - length_m) <= apart_m)) continue;
      int first;
      if (!wt_one_path(&other, &path, other_row, row, &first)) continue;
      if (first) return;
      found |= solved[other_row / 2].quarters;
    }
  quarters[place] = (uchar)found;
  const int is_near = wt_is_near(&world, &path);
  stays[place] = is_near ? WT_ROW_IS_NEAR : WT_ROW_STAYS;
  if (is_near) {
    atomic_inc(&counters->near_rows);
  } else {
    atomic_inc(&counters->rows);
    atomic_add(&counters->row_vertices, path.depth);
  }
}

// Orders rows of one key by wt_compare_rows. rows: the row at each place, WT_NO_ROW where none stays or it is near;
// counts: 1 where one stays, and after those of all places its number of interactions.
kernel void order_rows(const global wt_solved* solved, const global double* vertices, const global uint* steps,
                       const global double* transmitters, const global double* receivers,
                       const global uint* receiver_of, const global uint* transmitter_of, const global uint* keys,
                       const global uint* order, const global double* lengths, const global uchar* stays,
                       const global uchar* quarters, global uint* rows, global double* delays, global uint* counts,
                       global uchar* row_quarters, wt_distinct_arguments args) {
  const uint place = get_global_id(0);
  if (place >= args.row_count) return;
  const uint scale = args.twins ? 1u : 2u, row = scale * order[place], key = keys[place];
  if (key == WT_NONE) {
    rows[place] = WT_NO_ROW;
    counts[place] = counts[args.row_count + place] = 0;
    return;
  }
  const wt_path_list list = {solved,    vertices,    steps,          transmitters,
                             receivers, receiver_of, transmitter_of, args.max_depth};
  prefetch_row(&list, keys, order, lengths, place + WT_AHEAD, args);
  const wt_path path = wt_path_of(&list, row);
  const double delay_s = lengths[order[place]] / WT_SPEED_OF_LIGHT;
  uint to = place;
  for (int way = -1; way <= 1; way += 2)
    for (uint i = place + way; i < args.row_count && keys[i] == key; i += way) {
      const uint other_row = scale * order[i];
      const wt_path other = wt_path_of(&list, other_row);
      int compared = wt_compare_rows(&other, &path, lengths[order[i]] / WT_SPEED_OF_LIGHT, delay_s);
      if (compared == 0) compared = wt_three_way_of_numbers(other_row, row);
      if (way < 0 && compared > 0) --to;
      if (way > 0 && compared < 0) ++to;
    }
  const int is_row = stays[place] == WT_ROW_STAYS;
  rows[to] = is_row ? row : WT_NO_ROW;
  delays[to] = delay_s;
  counts[to] = is_row ? 1u : 0u;
  counts[args.row_count + to] = is_row ? path.depth : 0u;
  row_quarters[to] = quarters[place];
}
