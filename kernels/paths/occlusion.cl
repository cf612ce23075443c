// SPDX-License-Identifier: Apache-2.0
// occlusion: finds solved paths with an obstructed leg; lib/legs.clh has the rule. A work-item takes one leg; legs from
// args.first_leg on are ordered by their number first, then by path, so that neighbours traverse alike. First legs have
// a launch of their own: paths over one tile follow each other and share their first leg, which is tested once, and
// later legs of a hidden path need no test. With WT_PACKETS a work-item takes all legs of 16 paths, those of one number
// together (lib/leg_packet.clh); the result is the same. Consumes solved paths; sets wt_solved::blocked. wedges,
// surface_of_tile, targets: see lib/leg.clh. Open rows end at their last vertex. blockers: if given, the triangle that
// hides a path is stored there.
#include "lib/blockers.clh"
#include "lib/count.clh"
#ifdef WT_PACKETS
#include "lib/leg_packet.clh"
#define WT_PACKET_ARGUMENTS const global wt_bvh2_node *packet_nodes, const global wt_bvh2_triangle *packet_triangles,
#else
#define WT_PACKET_ARGUMENTS
#endif
#include "wavetracer/device/arguments.h"

// At most this many paths share a test.
#define WT_SHARING 16u

// Does path i have the same first leg as the path before it, and is it not the first of those that share a test?
inline int wt_shares_first_leg(const global wt_solved* solved, const global uint* sequences, uint max_depth, uint i) {
  if (i % WT_SHARING == 0 || solved[i].depth == 0 || solved[i - 1].depth == 0) return 0;
  const uint step = sequences[(size_t)i * max_depth];
  return (step & WT_STEP_KIND) == WT_STEP_SCATTERING && step == sequences[(size_t)(i - 1) * max_depth] &&
         solved[i].transmitter == solved[i - 1].transmitter;
}

// Path i, and those that share its first leg, are hidden by the triangle at this place.
inline void hide(global wt_solved* solved, const global uint* sequences, uint i, uint count, uint leg, uint place,
                 global uint* blockers, wt_legs_arguments args) {
  uint k = i;
  do {
    atomic_or(&solved[k].blocked, 1u);
    wt_remember_blocker(blockers, args.blocker_mask, solved[k].node, solved[k].receiver, leg, place);
    ++k;
  } while (leg == 0 && k < count && wt_shares_first_leg(solved, sequences, args.max_depth, k));
}

#ifdef WT_PACKETS
// A work-item takes WT_PACKETS blocks of 16 paths, one after the other; what hid a leg of one block is tried first in
// the next. Legs from this number on share the last entry.
#define PACKET_LEGS 8u

// The most legs of the paths from `first` on.
inline uint most_legs(const global wt_solved* solved, uint first, uint end, uint open) {
  uint legs = 0;
  for (uint i = first; i < end; ++i)
    if (solved[i].depth + 1 > open) legs = max(legs, solved[i].depth + 1 - open);
  return legs;
}

// All legs of the 16 paths from `first` on, those at the receivers first: they hide most of the hidden paths, and the
// other legs of these need no test. Where blockers remember what hid paths, each leg is tested alone, since the tree of
// packets has other places.
inline void test_paths(const global WT_NODE* nodes, const global WT_LEAF* triangles, const global float4* moving,
                       const global double4* transmitters, const global double4* receivers,
                       const global wt_exact_surface* surfaces, const global double* corners, global wt_solved* solved,
                       const global double* vertices, const global uint* sequences, const wt_step_tables* tables,
                       global uint* blockers, const global wt_bvh2_node* packet_nodes,
                       const global wt_bvh2_triangle* packet_triangles, uint first, uint count, wt_last_hider* last,
                       wt_legs_arguments args) {
  const uint end = min(first + WT_SHARING, count);
  wt_leg_source source = {tables, transmitters, receivers, solved, vertices, sequences, first, args.max_depth, 0};
  wt_leg_block block;
  int begun[WT_SHARING];  // not 0: the end of the leg is set, because it is the begin of the one before
  wt_clear_block(&block);
  for (uint lane = 0; lane < WT_SHARING; ++lane) begun[lane] = 0;
  for (uint leg = most_legs(solved, first, end, args.open); leg-- > 0;) {
    int packed = 0;
    source.number = leg;
    const uint side = wt_begin_side(leg);
    for (uint i = first, lane = 0; lane < WT_SHARING; ++i, ++lane) {
      block.verdicts[lane] = WT_LEG_LEFT_OUT;
      if (i >= end || leg + args.open > solved[i].depth) continue;
      const int asked = leg == 0 && i + 1 < end && wt_shares_first_leg(solved, sequences, args.max_depth, i + 1);
      if (solved[i].blocked && !asked) {
        begun[lane] = 0;
        continue;
      }
      const size_t row = (size_t)i * args.max_depth;
      if (!begun[lane])
        block.mirrors[lane] = wt_set_stop(&block, 1 - side, lane, surfaces, solved + i, leg + 1, vertices + 3 * row,
                                          sequences + row, transmitters, receivers);
      const int to_mirror = block.mirrors[lane];
      block.mirrors[lane] = wt_set_stop(&block, side, lane, surfaces, solved + i, leg, vertices + 3 * row,
                                        sequences + row, transmitters, receivers);
      block.plain[lane] = to_mirror && block.mirrors[lane];
      begun[lane] = 1;
      if (leg == 0 && wt_shares_first_leg(solved, sequences, args.max_depth, i)) continue;
      block.verdicts[lane] = blockers ? WT_LEG_UNSURE : WT_LEG_FREE;
      packed |= block.verdicts[lane] == WT_LEG_FREE;
    }
    if (packed)
      wt_test_leg_block(packet_nodes, packet_triangles, args.triangle_slots, args.extent_m, &source,
                        last + min(leg, PACKET_LEGS - 1u), &block);
    for (uint i = first, lane = 0; i < end; ++i, ++lane) {
      uint place = WT_NONE;
      int hidden = block.verdicts[lane] == WT_LEG_HIDDEN;
      if (block.verdicts[lane] == WT_LEG_UNSURE) {
        wt_leg l;
        wt_leg_of_lane(&source, lane, &l);
        hidden =
            wt_obstructed(nodes, triangles, args.triangle_slots, args.extent_m, moving, surfaces, corners, &l, &place);
      }
      if (hidden) hide(solved, sequences, i, count, leg, place, blockers, args);
    }
  }
}
#endif

kernel void occlusion(const global WT_NODE* nodes, const global WT_LEAF* triangles, const global float4* moving,
                      const global double4* transmitters, const global double4* receivers,
                      const global wt_exact_surface* surfaces, const global double* corners, global wt_solved* solved,
                      const global double* vertices, const global uint* sequences, const global wt_wedge* wedges,
                      const global uint* surface_of_tile, const global wt_target_point* targets, global uint* blockers,
                      const global wt_counters* counters, WT_PACKET_ARGUMENTS wt_legs_arguments args) {
  const uint count = wt_length(counters, args.solved_counter, args.solved_count);
  const wt_step_tables tables = {surfaces, wedges, surface_of_tile, args.tile_count, targets};
#ifdef WT_PACKETS
  wt_last_hider last[PACKET_LEGS];
  for (uint leg = 0; leg < PACKET_LEGS; ++leg) last[leg].place = WT_NONE;
  for (uint block = 0; block < WT_PACKETS; ++block) {
    const uint first = WT_SHARING * (WT_PACKETS * get_global_id(0) + block);
    if (first >= count) return;
    test_paths(nodes, triangles, moving, transmitters, receivers, surfaces, corners, solved, vertices, sequences,
               &tables, blockers, packet_nodes, packet_triangles, first, count, last, args);
  }
#else
  const uint i = get_global_id(0), leg = args.first_leg + get_global_id(1);
  if (i >= count || leg + args.open > solved[i].depth) return;
  if (leg == 0 && wt_shares_first_leg(solved, sequences, args.max_depth, i)) return;
  // Most paths are obstructed, and a leg that was found obstructed saves the later ones. A leg tested too early to see
  // that does no harm. First legs are always tested, since others wait for the answer.
  if (leg > 0 && wt_load_relaxed_u32(&solved[i].blocked)) return;
  const size_t row = (size_t)i * args.max_depth;
  wt_leg l;
  wt_leg_of(&tables, solved + i, leg, vertices + 3 * row, sequences + row, transmitters, receivers, &l);
  uint place;
  if (wt_obstructed(nodes, triangles, args.triangle_slots, args.extent_m, moving, surfaces, corners, &l, &place))
    hide(solved, sequences, i, count, leg, place, blockers, args);
#endif
}
