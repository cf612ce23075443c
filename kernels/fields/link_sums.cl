// SPDX-License-Identifier: Apache-2.0
// link_sums: powers, delays and counts of the paths of each link, from the rows of a frame in their order (fields.cl)
// and the waves that they belong to (path_groups.cl), so that the host need not read the rows of a map.
// A link's rows are dealt out to PARTS parts, which are added in their order, so that one work-item or PARTS of them
// may take a link and the sums have the same bits.
#include "lib/link_rows.clh"
#include "lib/link_waves.clh"
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/elementary.h"
#pragma OPENCL FP_CONTRACT OFF

inline double power_of_row(const global wt_path_row* row) {
  double power = 0.0;
  for (uint k = 0; k < 8; ++k) power += row->a[k] * row->a[k];
  return power;
}

// The number of the path's kind: 0 line of sight, then those of interaction_kinds.hpp, of which the last one counts.
inline uint kind_of(uint met) { return met & 16u ? 5 : met & 2u ? 4 : met & 8u ? 3 : met & 4u ? 2 : met & 1u; }

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

// The sums over some rows of a link; response: the sums of their fields at the carrier.
typedef struct {
  wt_link_sum sum;
  double2 response[4];
} link_part;

inline link_part no_rows(void) {
  link_part part = {
      {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, {0.0, 0.0, 0.0, 0.0}, 0.0, {0, 0, 0, 0, 0, 0}, {0, 0, 0, 0}, 0, 0},
      {(double2)(0.0), (double2)(0.0), (double2)(0.0), (double2)(0.0)}};
  return part;
}

inline void add_row(link_part* part, const link_rows* of, uint at, double2* fields, uint values) {
  const global wt_path_row* row = of->rows + at;
  wt_link_sum* sum = &part->sum;
  const double power = power_of_row(row);
  const uint met = row->quarters >> WT_ROW_MET_SHIFT;
  sum->power += power;
  sum->mean_delay_s += power * row->delay_s;
  sum->rms_doppler_hz += power * row->doppler_hz;
  ++sum->kinds[kind_of(met)];
  if (met == 0)
    sum->direct += power;
  else
    count_found(sum, row->quarters, power);
  sum->near_edges += (row->quarters & WT_ROW_NEAR_EDGE) != 0;
  for (uint k = 0; k < values; ++k) part->response[k] += fields[k];
}

// The sums of a part; its rows' fields and entries are written if waves count.
inline link_part sums_of_part(const link_rows* of, uint part, const link_waves* waves, wt_link_sums_arguments args) {
  link_part out = no_rows();
  double2 fields[4];
  for (uint row = of->first + part; row < of->end; row += PARTS) {
    carrier_fields(of->rows + row, args.frequency_hz, args.values, fields);
    add_row(&out, of, row, fields, args.values);
    if (!args.grouped) continue;
    for (uint k = 0; k < args.values; ++k) waves->fields[args.values * (size_t)row + k] = fields[k];
    write_entries(waves, row);
  }
  return out;
}

inline void add_part(LINK_SPACE link_part* to, LINK_SPACE const link_part* part) {
  to->sum.power += part->sum.power;
  to->sum.mean_delay_s += part->sum.mean_delay_s;
  to->sum.rms_doppler_hz += part->sum.rms_doppler_hz;
  to->sum.direct += part->sum.direct;
  to->sum.amplitude += part->sum.amplitude;
  for (uint k = 0; k < 4; ++k) to->sum.found[k] += part->sum.found[k];
  for (uint k = 0; k < 4; ++k) to->sum.found_powers[k] += part->sum.found_powers[k];
  for (uint k = 0; k < 6; ++k) to->sum.kinds[k] += part->sum.kinds[k];
  to->sum.near_edges += part->sum.near_edges;
  for (uint k = 0; k < 4; ++k) to->response[k] += part->response[k];
}

// The squares of the deviations of delays (x) and Doppler shifts (y) from their means, weighted by power. mean: the
// mean delay and the mean shift.
inline double2 deviations_of_part(const link_rows* of, uint part, double2 mean, double power) {
  double2 out = (double2)(0.0);
  for (uint row = of->first + part; row < of->end; row += PARTS) {
    const double2 off = (double2)(of->rows[row].delay_s, of->rows[row].doppler_hz) - mean;
    out += off * off * (power_of_row(of->rows + row) / power);
  }
  return out;
}

// Sets means and the power of all fields together.
inline void finish(LINK_SPACE link_part* all, const link_rows* of, uint values) {
  LINK_SPACE wt_link_sum* sum = &all->sum;
  sum->paths = of->end - of->first;
  for (uint k = 0; k < values; ++k) {
    const double2 a = all->response[k];
    sum->narrowband += a.x * a.x + a.y * a.y;
  }
  if (sum->power > 0.0) {
    sum->mean_delay_s /= sum->power;
    sum->rms_doppler_hz /= sum->power;
  }
}

// WT_LANES work-items take a link. waves, shared and what follows up to `sums`: null where all paths are waves of their
// own (args.grouped is 0), else as link_waves has them.
kernel void link_sums(const global uint2* links, const global wt_path_row* rows, const global wt_path_wave* waves,
                      const global wt_path_waves* shared, global ulong* entries, global double2* fields,
                      global ulong* keys, global double2* sums, global wt_link_sum* out,
                      const global wt_counters* counters, wt_link_sums_arguments args) {
  const uint i = get_global_id(0) / WT_LANES, lane = wt_lane();
  if (i >= args.link_count) return;
  const link_rows of = rows_of_link(rows, min(counters->rows, args.row_capacity), links[i]);
  const link_waves grouped = {waves, shared, entries, fields, keys, sums, args.values};
  const uint parts = min(PARTS, of.end - of.first);
  LINK_SPACE link_part part[PARTS], all[1];
  LINK_SPACE double2 deviations[PARTS];
  LINK_SPACE double powers[PARTS];
  LINK_SPACE uint starts[PARTS + 1];
  LINK_SPACE ulong read[SLOTS_OF_ROW * WT_LANES];

  for (uint p = lane; p < parts; p += WT_LANES) part[p] = sums_of_part(&of, p, &grouped, args);
  for (uint p = lane; args.grouped && p <= PARTS; p += WT_LANES) starts[p] = 0;
  WT_SYNC();
  if (lane == 0) {
    all[0] = no_rows();
    for (uint p = 0; p < parts; ++p) add_part(all, part + p);
    finish(all, &of, args.values);
  }
  if (args.grouped) count_entries(&grouped, of.first, of.end, starts);
  WT_SYNC();
  const double2 mean = (double2)(all->sum.mean_delay_s, all->sum.rms_doppler_hz);
  for (uint p = lane; p < parts; p += WT_LANES) deviations[p] = deviations_of_part(&of, p, mean, all->sum.power);
  if (args.grouped && lane == 0) place_tables(of.end - of.first, starts);
  WT_SYNC();
  if (args.grouped) clear_tables(&grouped, of.first, starts);
  for (uint row = of.first; row < (args.grouped ? of.end : of.first); row += WT_LANES) {
    read_entries(&grouped, row, of.end, read);
    WT_SYNC();
    add_entries(&grouped, of.first, row, starts, read);
    WT_SYNC();
  }
  for (uint p = lane; args.grouped && p < PARTS; p += WT_LANES)
    powers[p] = power_of_owner(&grouped, of.first, p, starts);
  WT_SYNC();
  if (lane != 0) return;
  wt_link_sum sum = all->sum;
  double2 squares = (double2)(0.0);
  for (uint p = 0; p < parts; ++p) squares += deviations[p];
  sum.rms_delay_s = sum.power > 0.0 ? sqrt(squares.x) : 0.0;
  sum.rms_doppler_hz = sum.power > 0.0 ? sqrt(squares.y) : 0.0;
  sum.grouped = args.grouped ? 0.0 : sum.power;
  for (uint p = 0; args.grouped && p < PARTS; ++p) sum.grouped += powers[p];
  out[i] = sum;
}
