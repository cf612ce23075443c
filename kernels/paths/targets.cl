// SPDX-License-Identifier: Apache-2.0
// targets: paths transmitter - point of a target - receiver, a row for every link and every point. Legs are not tested.
// For paths with reflections around a target, solve has found the ways between ends and points; target_rows makes open
// rows of them, which end at the point, and their sort keys.
#include "lib/count.clh"
#include "lib/images.clh"
#include "wavetracer/device/points.h"
#pragma OPENCL FP_CONTRACT OFF

// Does the vehicle that carries the end also carry the point? Then the end does not see it.
inline int carries(const global wt_target_point* point, double4 end) {
  return point->instance != WT_NONE && point->instance == wt_end_instance(end);
}

// A work-item writes rows_per_item rows. links: transmitter and receiver; rows are ordered by links, then by points. No
// ray found these rows, so every quarter of a launch counts as having found them. Rows of targets that are absent, or
// whose vehicle carries an end, are marked as obstructed.
kernel void targets(const global uint2* links, const global wt_target_point* points, const global double4* transmitters,
                    const global double4* receivers, global wt_solved* solved, global double* vertices,
                    global uint* sequences, wt_targets_arguments args) {
  const ulong begin = (ulong)get_global_id(0) * args.rows_per_item;
  if (begin >= args.row_count) return;
  const uint end = (uint)min(begin + args.rows_per_item, (ulong)args.row_count);
  for (uint row = (uint)begin; row < end; ++row) {
    const uint2 link = links[row / args.points];
    const uint number = row % args.points;
    const global wt_target_point* point = points + number;
    solved[row].transmitter = link.x;
    solved[row].receiver = link.y;
    solved[row].depth = 1;
    solved[row].blocked = !point->present || carries(point, transmitters[link.x]) || carries(point, receivers[link.y]);
    solved[row].node = WT_NONE;
    solved[row].quarters = WT_ALL_QUARTERS;
    const size_t at = (size_t)row * args.max_depth;
    vstore3((double3)(point->position[0], point->position[1], point->position[2]), at, vertices);
    sequences[at] = WT_STEP_TARGET | number;
  }
}

// A work-item takes one row of solve, whose receiver is a point: the point becomes its last vertex. keys: wt_point_key
// of the point; hidden, larger than all others, for a row that is obstructed, has no room for the point, or whose end
// rides with the point.
kernel void target_rows(const global wt_target_point* points, const global double4* ends, global wt_solved* solved,
                        global double* vertices, global uint* sequences, global uint* keys, uint count, uint max_depth,
                        uint most_depth, uint hidden) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const uint number = solved[i].receiver, depth = solved[i].depth;
  const global wt_target_point* point = points + number;
  keys[i] = hidden;
  if (solved[i].blocked || depth >= most_depth || !point->present || carries(point, ends[solved[i].transmitter]))
    return;
  const size_t at = (size_t)i * max_depth + depth;
  vstore3((double3)(point->position[0], point->position[1], point->position[2]), at, vertices);
  sequences[at] = WT_STEP_TARGET | number;
  solved[i].depth = depth + 1;
  keys[i] = wt_point_key(number, 0);
}
