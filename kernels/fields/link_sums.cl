// SPDX-License-Identifier: Apache-2.0
// link_sums: powers, delays and counts of the paths of each link, from the rows of a frame in their order (fields.cl)
// and the waves that they belong to (path_groups.cl), so that the host need not read the rows of a map.
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/elementary.h"
#include "wavetracer/device/field_records.h"
#include "wavetracer/device/path_groups.h"
#pragma OPENCL FP_CONTRACT OFF

// Slots of the waves of one link, a hash table with room for the four waves of each of its rows. A key of 0 is an empty
// slot; its lowest two bits say that there is a wave, and that a path without an edge belongs to it.
#define SLOTS_OF_ROW 4u
#define IS_WAVE 1ul
#define IS_STRAIGHT 2ul

typedef struct {
  global ulong* keys;
  global double2* sums;  // args.values fields of each slot
  uint count, values;
} wave_table;

// Returns the slot of a wave, which is entered if it is new.
inline uint slot_of(const wave_table* table, ulong key) {
  const ulong wanted = (key & ~3ul) | IS_WAVE;
  uint at = (uint)(key % table->count);
  while (table->keys[at] != 0 && (table->keys[at] & ~IS_STRAIGHT) != wanted) at = at + 1 == table->count ? 0 : at + 1;
  if (table->keys[at] == 0) table->keys[at] = wanted;
  return at;
}

// Adds the fields of a path, with their phases, to its waves. A second straight path of the same steps is a wave of its
// own (host/radio/group_numbers.cpp has the same rule).
inline void add_to_waves(const wave_table* table, const global wt_path_wave* own, const global wt_path_waves* shared,
                         uint row, const double2* fields) {
  int is_twin = 0;
  if (!own->bends) {
    const uint at = slot_of(table, own->key);
    is_twin = (table->keys[at] & IS_STRAIGHT) != 0;
    table->keys[at] |= IS_STRAIGHT;
  }
  const int alone = own->shared == WT_ONE_WAVE;
  const uint count = alone ? 1 : shared[own->shared].count;
  for (uint i = 0; i < count; ++i) {
    const ulong key = alone ? own->key : shared[own->shared].keys[i];
    const double weight = alone ? 1.0 : shared[own->shared].weights[i];
    global double2* to = table->sums + (size_t)table->values * slot_of(table, is_twin ? wt_mixed(key, row) : key);
    for (uint k = 0; k < table->values; ++k) to[k] += weight * fields[k];
  }
}

inline double power_of_waves(const wave_table* table) {
  double power = 0.0;
  for (uint at = 0; at < table->count; ++at) {
    if (table->keys[at] == 0) continue;
    for (uint k = 0; k < table->values; ++k) {
      const double2 a = table->sums[(size_t)table->values * at + k];
      power += a.x * a.x + a.y * a.y;
    }
  }
  return power;
}

inline int is_of(const global wt_path_row* row, uint2 link) { return row->tx == link.x && row->rx == link.y; }

// The first of the rows whose link is not before this one.
inline uint first_row(const global wt_path_row* rows, uint count, uint2 link) {
  uint low = 0, high = count;
  while (low < high) {
    const uint middle = (low + high) / 2;
    if (rows[middle].tx < link.x || (rows[middle].tx == link.x && rows[middle].rx < link.y))
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

inline double power_of_row(const global wt_path_row* row) {
  double power = 0.0;
  for (uint k = 0; k < 8; ++k) power += row->a[k] * row->a[k];
  return power;
}

// The number of the path's kind: 0 line of sight, then those of interaction_kinds.hpp, of which the last one counts.
inline uint kind_of(const global wt_vertex_row* vertices, uint first, uint end) {
  uint met = 0;
  for (uint k = first; k < end; ++k) met |= vertices[k].interaction;
  return met & 2u ? 4 : met & 8u ? 3 : met & 4u ? 2 : met & 1u;
}

// Counts a path by the quarters of the launch that found it (wavetracer/missed.hpp).
inline void count_found(wt_link_sum* sum, uint quarters, double power) {
  const uint by = max(popcount(quarters & 15u), 1u) - 1;
  ++sum->found[by];
  sum->found_powers[by] += power;
  sum->amplitude += sqrt(power);
}

// The fields of a row at the carrier, with the phase of its delay.
inline void carrier_fields(const global wt_path_row* row, double frequency_hz, uint values, double2* fields) {
  const double turns = frequency_hz * row->delay_s;
  const wt_double2 phase = wt_cos_sin(-6.283185307179586 * (turns - floor(turns)));
  for (uint k = 0; k < values; ++k) {
    const uint at = values == 1 ? 0 : k;
    const double x = row->a[2 * at], y = row->a[2 * at + 1];
    fields[k] = (double2)(x * phase.x - y * phase.y, x * phase.y + y * phase.x);
  }
}

// Deviations from the means, and the powers of all fields together and of waves.
inline void finish(wt_link_sum* sum, const global wt_path_row* rows, uint first, uint end, const double2* response,
                   uint values) {
  for (uint k = 0; k < values; ++k) sum->narrowband += response[k].x * response[k].x + response[k].y * response[k].y;
  if (!(sum->power > 0.0)) return;
  sum->mean_delay_s /= sum->power;
  const double mean_hz = sum->rms_doppler_hz / sum->power;
  double delays = 0.0, shifts = 0.0;
  for (uint i = first; i < end; ++i) {
    const double share = power_of_row(rows + i) / sum->power;
    const double late = rows[i].delay_s - sum->mean_delay_s, shift = rows[i].doppler_hz - mean_hz;
    delays += share * late * late;
    shifts += share * shift * shift;
  }
  sum->rms_delay_s = sqrt(delays);
  sum->rms_doppler_hz = sqrt(shifts);
}

// One link per work-item. keys, sums: SLOTS_OF_ROW slots for each row, all 0; waves, shared: null where all paths are
// waves of their own (args.grouped is 0).
kernel void link_sums(const global uint2* links, const global wt_path_row* rows, const global wt_vertex_row* vertices,
                      const global wt_path_wave* waves, const global wt_path_waves* shared, global ulong* keys,
                      global double2* sums, global wt_link_sum* out, const global wt_counters* counters,
                      wt_link_sums_arguments args) {
  const uint i = get_global_id(0);
  if (i >= args.link_count) return;
  const uint2 link = links[i];
  const uint count = min(counters->rows, args.row_capacity), first = first_row(rows, count, link);
  uint end = first;
  while (end < count && is_of(rows + end, link)) ++end;
  const size_t slots = (size_t)first * SLOTS_OF_ROW;
  const wave_table table = {keys + slots, sums + slots * args.values, (end - first) * SLOTS_OF_ROW, args.values};
  wt_link_sum sum = {0.0,          0.0, 0.0, 0.0, 0.0, 0.0, 0.0, {0.0, 0.0, 0.0, 0.0}, 0.0, {0, 0, 0, 0, 0},
                     {0, 0, 0, 0}, 0,   0,   0};
  double2 response[4] = {(double2)(0.0), (double2)(0.0), (double2)(0.0), (double2)(0.0)}, fields[4];
  for (uint row = first; row < end; ++row) {
    const double power = power_of_row(rows + row);
    const uint last = row + 1 < count ? rows[row + 1].first_vertex : counters->row_vertices;
    const uint kind = kind_of(vertices, rows[row].first_vertex, last);
    sum.power += power;
    sum.mean_delay_s += power * rows[row].delay_s;
    sum.rms_doppler_hz += power * rows[row].doppler_hz;
    ++sum.kinds[kind];
    if (rows[row].first_vertex == last)
      sum.direct += power;
    else
      count_found(&sum, rows[row].quarters, power);
    sum.near_edges += (rows[row].quarters & WT_ROW_NEAR_EDGE) != 0;
    carrier_fields(rows + row, args.frequency_hz, args.values, fields);
    for (uint k = 0; k < args.values; ++k) response[k] += fields[k];
    if (args.grouped) add_to_waves(&table, waves + row, shared, row, fields);
  }
  sum.paths = end - first;
  finish(&sum, rows, first, end, response, args.values);
  sum.grouped = args.grouped ? power_of_waves(&table) : sum.power;
  out[i] = sum;
}
