// SPDX-License-Identifier: Apache-2.0
// occlusion: finds solved paths with an obstructed leg. A work-item takes one leg; legs from args.first_leg on are
// ordered by their number first, then by path, so that neighbours traverse alike; lib/legs.clh has the rule. First legs
// have a launch of their own: paths over one tile follow each other and share their first leg, which is tested once,
// and later legs of a hidden path need no test. Consumes solved paths; sets wt_solved::blocked. wedges,
// surface_of_tile, targets: see lib/leg.clh. Open rows end at their last vertex. blockers: if given, the triangle that
// hides a path is stored there.
#include "lib/blockers.clh"
#include "lib/count.clh"
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

kernel void occlusion(const global WT_NODE* nodes, const global WT_LEAF* triangles, const global float4* moving,
                      const global double4* transmitters, const global double4* receivers,
                      const global wt_exact_surface* surfaces, const global double* corners, global wt_solved* solved,
                      const global double* vertices, const global uint* sequences, const global wt_wedge* wedges,
                      const global uint* surface_of_tile, const global wt_target_point* targets, global uint* blockers,
                      const global wt_counters* counters, wt_legs_arguments args) {
  const uint i = get_global_id(0), leg = args.first_leg + get_global_id(1);
  const uint count = wt_length(counters, args.solved_counter, args.solved_count);
  if (i >= count || leg + args.open > solved[i].depth) return;
  if (leg == 0 && wt_shares_first_leg(solved, sequences, args.max_depth, i)) return;
  // Most paths are obstructed, and a leg that was found obstructed saves the later ones. A leg tested too early to see
  // that does no harm. First legs are always tested, since others wait for the answer.
  if (leg > 0 && wt_load_relaxed_u32(&solved[i].blocked)) return;
  const size_t row = (size_t)i * args.max_depth;
  const wt_step_tables tables = {surfaces, wedges, surface_of_tile, args.tile_count, targets};
  wt_leg l;
  wt_leg_of(&tables, solved + i, leg, vertices + 3 * row, sequences + row, transmitters, receivers, &l);
  uint place;
  if (!wt_obstructed(nodes, triangles, args.triangle_slots, args.extent_m, moving, surfaces, corners, &l, &place))
    return;
  uint k = i;
  do {
    atomic_or(&solved[k].blocked, 1u);
    wt_remember_blocker(blockers, args.blocker_mask, solved[k].node, solved[k].receiver, leg, place);
    ++k;
  } while (leg == 0 && k < count && wt_shares_first_leg(solved, sequences, args.max_depth, k));
}
