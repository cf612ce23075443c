// SPDX-License-Identifier: Apache-2.0
// solve: the image method in double for every candidate; it keeps those whose points lie inside their surfaces, on the
// lit sides. Legs are not tested here (occlusion does that), except with WT_BLOCKERS, against the triangle that hid the
// path before: such paths are counted as hidden, and not kept.
#ifdef WT_BLOCKERS
#include "lib/blockers.clh"
#endif
#include "lib/reflections.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

#ifdef WT_BLOCKERS
inline int hidden(const global WT_LEAF* triangles, uint triangle_slots, const global uint* blockers, uint mask,
                  const global wt_exact_surface* surfaces, const global double* corners, const uint* chain, uint depth,
                  uint node, uint receiver, double4 from, double4 to, const double3* points) {
  const uint noted = blockers[wt_blocker_slot(node, receiver, mask)], k = noted >> WT_BLOCKER_SHIFT;
  if (noted == WT_NONE || k > depth) return 0;
  const wt_step_tables tables = {surfaces, 0, 0, 0, 0};
  wt_leg leg;
  if (k == 0)
    wt_stop_at_end(from, &leg.from);
  else
    wt_stop_at_vertex(&tables, points[k - 1], chain[k - 1], &leg.from);
  if (k == depth)
    wt_stop_at_end(to, &leg.to);
  else
    wt_stop_at_vertex(&tables, points[k], chain[k], &leg.to);
  const double3 before = k > 1 ? points[k - 2] : from.xyz;
  // Triangles of vehicles are not stored, so those of the antennas' vehicles need no exception.
  wt_complete_leg(&tables, before, k > 1 ? wt_rounding(before) : WT_ON_SURFACE_M, &leg);
  return wt_obstructed_at(triangles, triangle_slots, surfaces, corners, &leg, noted & (WT_BLOCKER_PLACES - 1));
}

inline void prefetch_blocker(const global uint* blockers, uint mask, const global wt_candidate* candidate) {
  wt_prefetch(blockers + wt_blocker_slot(candidate->node, candidate->receiver, mask));
}
#define WT_BLOCKER_ARGUMENTS const global WT_LEAF *leaves, const global uint *blockers,
#else
#define WT_BLOCKER_ARGUMENTS
#endif

// Begins to read the chains of the candidates that follow candidate i.
inline void prefetch_chains(const global ulong* table, const global wt_candidate* candidates, uint i, uint count) {
  for (uint step = 0; WT_AHEAD > 1 && step < 3 && i + (WT_AHEAD >> step) < count; ++step)
    wt_chain_prefetch(table, candidates[i + (WT_AHEAD >> step)].node, step);
}

kernel void solve(const global ulong* table, const global uint* quarters, const global double4* transmitters,
                  const global double4* receivers, const global wt_exact_surface* surfaces,
                  const global double* triangles, const global wt_exact_instance* instances,
                  const global wt_candidate* candidates, global wt_solved* solved, global double* vertices,
                  global uint* sequences, global wt_counters* counters, WT_BLOCKER_ARGUMENTS wt_solve_arguments args) {
  const uint i = get_global_id(0), count = min(args.candidate_count, counters->candidates);
  if (i >= count) return;
  prefetch_chains(table, candidates, i, count);
#ifdef WT_BLOCKERS
  if (i + WT_AHEAD < count) prefetch_blocker(blockers, args.blocker_mask, candidates + i + WT_AHEAD);
#endif
  uint chain[WT_MAX_DEPTH], transmitter;
  const uint depth = wt_chain(table, candidates[i].node, chain, &transmitter);
  // The vehicle that carries an antenna does not reflect for it, as it hides nothing from it.
  if (depth > 0) {
    const uint first = surfaces[chain[0]].instance, last = surfaces[chain[depth - 1]].instance;
    if ((first != WT_NONE && first == wt_end_instance(transmitters[transmitter])) ||
        (last != WT_NONE && last == wt_end_instance(receivers[candidates[i].receiver])))
      return;
  }
  double3 images[WT_MAX_DEPTH + 1], points[WT_MAX_DEPTH];
  images[0] = transmitters[transmitter].xyz;
  for (uint k = 0; k < depth; ++k) images[k + 1] = wt_reflected(surfaces + chain[k], images[k]);
  const double3 to = receivers[candidates[i].receiver].xyz;
  if (!wt_reflection_points(surfaces, triangles, instances, chain, depth, images, to, points)) return;
#ifdef WT_BLOCKERS
  if (hidden(leaves, args.triangle_slots, blockers, args.blocker_mask, surfaces, triangles, chain, depth,
             candidates[i].node, candidates[i].receiver, transmitters[transmitter], receivers[candidates[i].receiver],
             points)) {
    atomic_inc(&counters->hidden);
    return;
  }
#endif
  const uint slot = atomic_inc(&counters->solved);
  if (slot >= args.capacity) return;
  solved[slot].transmitter = transmitter;
  solved[slot].receiver = candidates[i].receiver;
  solved[slot].depth = depth;
  solved[slot].blocked = 0;
  solved[slot].node = candidates[i].node;
  solved[slot].quarters = wt_found_by(quarters, candidates[i].node);
  for (uint k = 0; k < depth; ++k) {
    const size_t at = (size_t)slot * args.max_depth + k;
    vstore3(points[k], at, vertices);
    sequences[at] = chain[k];
  }
}
