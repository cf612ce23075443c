// SPDX-License-Identifier: Apache-2.0
// targets: paths transmitter - point of a target - receiver, a row for every link and every point. Legs are not tested.
// For paths with reflections around a target, solve has found the ways between ends and points; target_rows makes open
// rows of them, which end at the point, and their sort keys.
#include "lib/count.clh"
#include "lib/images.clh"
#include "lib/prefetch.clh"
#include "lib/target_point.clh"
#include "wavetracer/device/points.h"
#pragma OPENCL FP_CONTRACT OFF

// A work-item takes rows_per_item rows. links: transmitter and receiver; rows are ordered by links, then by points. No
// ray found these rows, so every quarter of a launch counts as having found them. Rows of targets that are absent, or
// whose vehicle carries an end, are marked as obstructed, and so are those whose ends do not see one lit side of a
// piece of a body.
// counts: null, or then rows that would be marked are left out, and others written wherever there is room: their number
// is added to its first word, and to the others, with a carry, that of paths below the floor. powers: for each point,
// see wt_is_weak_by; null without a floor.
kernel void targets(const global uint2* links, const global wt_target_point* points, const global double* powers,
                    const global double4* transmitters, const global double4* receivers,
                    const global wt_exact_surface* surfaces, global wt_solved* solved, global double* vertices,
                    global uint* sequences, global uint* counts, wt_targets_arguments args) {
  const ulong begin = (ulong)get_global_id(0) * args.rows_per_item;
  if (begin >= args.row_count) return;
  const uint end = (uint)min(begin + args.rows_per_item, (ulong)args.row_count);
  uint weak = 0;
  for (uint row = (uint)begin; row < end; ++row) {
    const uint2 link = links[row / args.points];
    const uint number = row % args.points;
    const global wt_target_point* point = points + number;
    const double4 from = transmitters[link.x], to = receivers[link.y];
    const uint blocked = !point->present || wt_carries(point, from) || wt_carries(point, to) ||
                         !(wt_seen_side(point, surfaces, from.xyz) & wt_seen_side(point, surfaces, to.xyz));
    uint slot = row;
    if (counts) {
      if (blocked) continue;
      if (powers && wt_is_weak_by(point, powers[number], args.floor, from.xyz, to.xyz)) {
        ++weak;
        continue;
      }
      slot = wt_take_places(counts, 1);
      if (slot >= args.capacity) continue;
    }
    solved[slot].transmitter = link.x;
    solved[slot].receiver = link.y;
    solved[slot].depth = 1;
    solved[slot].blocked = blocked;
    solved[slot].node = WT_NONE;
    solved[slot].quarters = WT_ALL_QUARTERS;
    const size_t at = (size_t)slot * args.max_depth;
    vstore3(wt_point_place(point), at, vertices);
    sequences[at] = WT_STEP_TARGET | number;
  }
  wt_count_weak(counts + 1, weak);
}

// A work-item takes one row of solve, whose receiver is a point: the point becomes its last vertex. keys: wt_point_key
// of the point and its side; hidden, larger than all others, for a row that is obstructed, has no room for the point,
// does not see a lit side of it, or whose end rides with the point.
kernel void target_rows(const global wt_target_point* points, const global double4* ends,
                        const global wt_exact_surface* surfaces, global wt_solved* solved, global double* vertices,
                        global uint* sequences, global uint* keys, uint count, uint max_depth, uint most_depth,
                        uint hidden) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const uint number = solved[i].receiver, depth = solved[i].depth;
  const global wt_target_point* point = points + number;
  keys[i] = hidden;
  if (solved[i].blocked || depth >= most_depth || !point->present || wt_carries(point, ends[solved[i].transmitter]))
    return;
  const size_t at = (size_t)i * max_depth + depth;
  const uint side =
      wt_seen_side(point, surfaces, depth > 0 ? vload3(at - 1, vertices) : ends[solved[i].transmitter].xyz);
  if (side == 0) return;
  vstore3(wt_point_place(point), at, vertices);
  sequences[at] = WT_STEP_TARGET | number;
  solved[i].depth = depth + 1;
  keys[i] = wt_point_key(number, side == 1);
}

// The body that the row's point of a target is a piece of, or WT_NONE.
inline uint body_of_row(const global wt_target_point* points, const global uint* steps, uint depth) {
  for (uint k = 0; k < depth; ++k) {
    if ((steps[k] & WT_STEP_KIND) != WT_STEP_TARGET) continue;
    const global wt_target_point* point = points + (steps[k] & ~WT_STEP_KIND);
    return point->surface == WT_NONE ? WT_NONE : point->instance;
  }
  return WT_NONE;
}

// A work-item takes one row. Bodies that are targets themselves neither mirror waves nor scatter or diffract them in
// other ways, since their facets send all of these: rows with such a step are marked as obstructed, but for bounces of
// target_bounces, whose mirrors are on the body of their piece. is_body: not 0 for each instance whose body is a
// target. wedges, surface_of_tile: null where steps name none; tiles from tile_count on are cells of vegetation.
kernel void target_bodies(const global wt_exact_surface* surfaces, const global wt_wedge* wedges,
                          const global uint* surface_of_tile, const global wt_target_point* points,
                          const global uint* is_body, global wt_solved* solved, const global uint* sequences,
                          const global wt_counters* counters, uint count, uint solved_counter, uint max_depth,
                          uint tile_count) {
  const uint i = get_global_id(0);
  if (i >= wt_length(counters, solved_counter, count)) return;
  const uint own = body_of_row(points, sequences + (size_t)i * max_depth, solved[i].depth);
  for (uint k = 0; k < solved[i].depth; ++k) {
    const uint step = sequences[(size_t)i * max_depth + k], number = step & ~WT_STEP_KIND, kind = step & WT_STEP_KIND;
    uint instance = WT_NONE;
    if (kind == WT_STEP_REFLECTION) instance = surfaces[number].instance;
    if (kind == WT_STEP_DIFFRACTION && wedges) instance = wedges[number].instance;
    if (kind == WT_STEP_SCATTERING && surface_of_tile && number < tile_count)
      instance = surfaces[surface_of_tile[number]].instance;
    if (kind == WT_STEP_REFLECTION && instance == own) continue;
    if (instance != WT_NONE && is_body[instance]) solved[i].blocked = 1;
  }
}
