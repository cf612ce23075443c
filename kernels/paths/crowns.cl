// SPDX-License-Identifier: Apache-2.0
// crowns: paths transmitter - cell - receiver, a row for every link and every cell of the vegetation that scatters.
// Legs are not tested.
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// A work-item writes rows_per_item rows. links: transmitter and receiver; rows are ordered by links, then by cells. No
// ray found these rows, so every quarter of a launch counts as having found them.
kernel void crowns(const global uint2* links, const global double* centres, global wt_solved* solved,
                   global double* vertices, global uint* sequences, wt_crowns_arguments args) {
  const ulong begin = (ulong)get_global_id(0) * args.rows_per_item;
  if (begin >= args.row_count) return;
  const uint end = (uint)min(begin + args.rows_per_item, (ulong)args.row_count);
  for (uint row = (uint)begin; row < end; ++row) {
    const uint2 link = links[row / args.cells];
    const uint cell = row % args.cells;
    solved[row].transmitter = link.x;
    solved[row].receiver = link.y;
    solved[row].depth = 1;
    solved[row].blocked = 0;
    solved[row].node = WT_NONE;
    solved[row].quarters = WT_ALL_QUARTERS;
    vstore3(vload3(cell, centres), (size_t)row * args.max_depth, vertices);
    sequences[(size_t)row * args.max_depth] = WT_STEP_SCATTERING | (args.first_tile + cell);
  }
}
