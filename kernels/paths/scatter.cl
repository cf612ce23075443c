// SPDX-License-Identifier: Apache-2.0
// scatter: paths transmitter - tile - receiver over the surfaces that a transmitter's rays saw directly. lit finds the
// receivers that each surface may serve; scatter writes a row for each of those and each tile. Legs are not tested.
#include "lib/count.clh"
#include "lib/tile.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// A work-item takes one node and one group of 16 receivers. Consumes the trie, for transmitters below
// transmitter_count; tiles_of: for each surface the number of its first tile, where the centre of that tile is, and the
// number of tiles.
// Appends (node, group, mask of receivers, tiles); *count is their number.
kernel void lit(const global ulong* table, const global uint* nodes, const global double4* transmitters,
                const global double4* receivers, const global ushort* links, const global wt_exact_surface* surfaces,
                const global uint4* tiles_of, global uint4* out, global uint* count, const global wt_counters* counters,
                wt_lit_arguments args) {
  const uint group = get_global_id(0) / args.node_count, i = get_global_id(0) % args.node_count;
  if (group >= args.groups || i >= wt_node_count(counters, args.node_count) || (nodes[i] & WT_ROOT)) return;
  const ulong key = table[nodes[i]];
  const uint transmitter = wt_trie_parent(key) & ~WT_ROOT, surface = wt_trie_surface(key);
  if (!(wt_trie_parent(key) & WT_ROOT) || transmitter >= args.transmitter_count || tiles_of[surface].z == 0) return;
  const global wt_exact_surface* s = surfaces + surface;
  const double above = wt_above(s, transmitters[transmitter].xyz);
  if (!(fabs(above) > WT_ON_SURFACE_M) || wt_carries(s, transmitters[transmitter])) return;
  uint keep = 0;
  for (uint wanted = links[(size_t)transmitter * args.groups + group]; wanted; wanted &= wanted - 1) {
    const uint bit = wanted & (~wanted + 1);
    const double4 receiver = receivers[16 * group + popcount(bit - 1u)];
    const double b = wt_above(s, receiver.xyz);
    if ((above > 0.0 ? b : -b) > WT_ON_SURFACE_M && !wt_carries(s, receiver)) keep |= bit;
  }
  if (keep == 0) return;
  const uint slot = atomic_inc(count);
  if (slot < args.capacity) out[slot] = (uint4)(nodes[i], group, keep, tiles_of[surface].z);
}

// A work-item writes rows_per_item rows. first_row: for each of lit's entries its first row, and row_count after the
// last; an entry's rows are ordered by tiles, then by receivers. centres: in the coordinates of the scene or model.
kernel void scatter(const global ulong* table, const global uint* quarters, const global uint4* entries,
                    const global uint* first_row, const global wt_exact_surface* surfaces, const global uint4* tiles_of,
                    const global double* centres, const global wt_exact_instance* instances, global wt_solved* solved,
                    global double* vertices, global uint* sequences, wt_scatter_arguments args) {
  const ulong begin = (ulong)get_global_id(0) * args.rows_per_item;
  if (begin >= args.row_count) return;
  uint entry = wt_entry_at(first_row, args.entry_count, begin);
  const uint end = (uint)min(begin + args.rows_per_item, (ulong)args.row_count);
  for (uint row = (uint)begin; row < end; ++row) {
    if (row == first_row[entry + 1]) ++entry;  // no entry is empty
    const ulong key = table[entries[entry].x];
    uint mask = entries[entry].z;
    const uint within = row - first_row[entry], receivers = popcount(mask), tile = within / receivers;
    for (uint skip = within % receivers; skip > 0; --skip) mask &= mask - 1;
    const uint surface = wt_trie_surface(key);
    const double3 p = wt_tile_centre(centres, instances, surfaces[surface].instance, tiles_of[surface].y + tile);
    solved[row].transmitter = wt_trie_parent(key) & ~WT_ROOT;
    solved[row].receiver = 16 * entries[entry].y + popcount((mask & (~mask + 1)) - 1u);
    solved[row].depth = 1;
    solved[row].blocked = 0;
    solved[row].node = entries[entry].x;
    solved[row].quarters = wt_found_by(quarters, entries[entry].x);
    vstore3(p, (size_t)row * args.max_depth, vertices);
    sequences[(size_t)row * args.max_depth] = WT_STEP_SCATTERING | (tiles_of[surface].x + tile);
  }
}
