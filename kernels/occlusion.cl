// occlusion: is a leg of a solved path obstructed? One leg per work-item; lib/legs.clh has the rule. The first legs of
// all paths come first, so that neighbours traverse alike, and later legs find most of what is hidden already decided.
// Consumes solved paths; sets wt_solved::blocked. wedges, surface_of_tile: see lib/leg.clh. blockers: where given, what
// hides a path is noted there.
#include "lib/blockers.clh"
#include "lib/count.clh"
#include "wavetracer/device/arguments.h"

kernel void occlusion(const global WT_NODE* nodes, const global WT_LEAF* triangles, const global float4* moving,
                      const global double4* transmitters, const global double4* receivers,
                      const global wt_exact_surface* surfaces, const global double* corners, global wt_solved* solved,
                      const global double* vertices, const global uint* sequences, const global wt_wedge* wedges,
                      const global uint* surface_of_tile, global uint* blockers, const global wt_counters* counters,
                      wt_legs_arguments args) {
  const uint i = get_global_id(0) % args.solved_count, leg = get_global_id(0) / args.solved_count;
  if (i >= wt_length(counters, args.solved_counter, args.solved_count) || leg > solved[i].depth) return;
  // Legs of a path follow each other, and most paths are obstructed: a leg that was found so spares the others. One
  // that comes too soon to see it does no harm.
  if (wt_load_relaxed_u32(&solved[i].blocked)) return;
  const size_t row = (size_t)i * args.max_depth;
  const wt_step_tables tables = {surfaces, wedges, surface_of_tile, args.tile_count};
  const wt_leg l = wt_leg_of(&tables, solved + i, leg, vertices + 3 * row, sequences + row, transmitters, receivers);
  uint place;
  if (!wt_obstructed(nodes, triangles, args.triangle_slots, args.extent_m, moving, surfaces, corners, l, &place))
    return;
  atomic_or(&solved[i].blocked, 1u);
  wt_remember_blocker(blockers, args.blocker_mask, solved[i].node, solved[i].receiver, leg, place);
}
