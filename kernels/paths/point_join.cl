// SPDX-License-Identifier: Apache-2.0
// point_join: paths over one tile, or one point of a target, with reflections or an edge before or after it, from
// prefixes of both ends that see the tile on one side. Their legs have been tested, so the rows need no further test.
#include "lib/join.clh"
#include "wavetracer/device/points.h"
#pragma OPENCL FP_CONTRACT OFF

// Writes the path from a's end over the tile to b's end. Rows of prefixes and of paths have max_depth vertices.
inline void write_path(const global wt_point_prefix* a, const global wt_point_prefix* b, uint receiver,
                       const global double* vertices, const global uint* steps, global wt_solved* path,
                       global double* out_vertices, global uint* out_steps, uint max_depth) {
  path->transmitter = a->end;
  path->receiver = receiver;
  path->depth = a->depth + b->depth - 1;
  path->blocked = 0;
  path->node = WT_NONE;
  path->quarters = a->quarters & b->quarters;
  for (uint k = 0; k < path->depth; ++k) {
    const size_t from =
        k < a->depth ? (size_t)a->row * max_depth + k : (size_t)b->row * max_depth + (b->depth - 2 - (k - a->depth));
    out_steps[k] = steps[from];
    vstore3(vload3(from, vertices), k, out_vertices);
  }
}

// `lanes` work-items take each prefix of a block, in order of their tiles, with all prefixes that see the same side of
// the same tile. keys: those of the prefixes, sorted; from args.hidden on they are of hidden ones. powers: for each
// tile a bound of the gain of paths over it whose parts are 1 m long; null without a floor. counts: the number of
// paths; the number of those that are left out because they are surely below the floor, in two words.
kernel void point_join(const global uint* keys, const global wt_point_prefix* prefixes, const global double* vertices,
                       const global uint* steps, const global uint* receiver_of_end, const global ushort* links,
                       const global double* powers, global wt_solved* solved, global double* out_vertices,
                       global uint* out_steps, global uint* counts, wt_point_join_arguments args) {
  const uint i = args.first + get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  if (i >= args.end || keys[i] >= args.hidden) return;
  const global wt_point_prefix* a = prefixes + i;
  if (a->end >= args.transmitter_count || a->depth > args.max_depth) return;
  const uint first = wt_lower_bound_before(keys, i, keys[i]);
  const double least_spread =
      powers ? args.floor / (powers[wt_tile_of_key(keys[i])] * a->spread) : 0.0;  // that b needs
  uint weak = 0;
  for (uint j = first + lane; j < args.count && keys[j] == keys[i]; j += args.lanes) {
    const global wt_point_prefix* b = prefixes + j;
    // scatter and targets make the paths without mirrors and edges.
    if (a->depth - a->transmissions + b->depth - b->transmissions <= 2) continue;
    if (a->depth + b->depth - 1 > args.max_depth || a->transmissions + b->transmissions > args.transmissions ||
        a->diffractions + b->diffractions > args.diffractions || a->diffractions + b->diffractions < args.bends)
      continue;
    const uint receiver = receiver_of_end[b->end];
    if (receiver == WT_NONE || !(links[(size_t)a->end * args.groups + receiver / 16] >> receiver % 16 & 1)) continue;
    if (b->spread < least_spread) {
      ++weak;
      continue;
    }
    const uint slot = wt_take_places(counts, 1);
    if (slot >= args.capacity) continue;
    const size_t at = (size_t)slot * args.row_depth;
    write_path(a, b, receiver, vertices, steps, solved + slot, out_vertices + 3 * at, out_steps + at, args.row_depth);
  }
  if (weak == 0) return;
  const uint before = atomic_add(counts + 1, weak);
  if (before + weak < before) atomic_inc(counts + 2);
}
