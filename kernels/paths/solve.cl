// SPDX-License-Identifier: Apache-2.0
// solve: the image method in double for every candidate; it keeps those whose points lie inside their surfaces, on the
// lit sides. Legs are not tested here (occlusion does that), except with WT_BLOCKERS, against the triangle that hid the
// path before: such paths are counted as hidden, and not kept.
#ifdef WT_BLOCKERS
#include "lib/blockers.clh"
#endif
#include "lib/found_rows.clh"
#include "lib/reflections.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

#ifdef WT_BLOCKERS
inline int hidden(const global WT_LEAF* triangles, uint triangle_slots, const global uint* blockers, uint mask,
                  const global wt_exact_surface* surfaces, const uint* chain, uint depth, uint node, uint receiver,
                  double4 from, double4 to, const double3* points) {
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
  return wt_surely_obstructed_at(triangles, triangle_slots, surfaces, &leg, noted & (WT_BLOCKER_PLACES - 1));
}

inline void prefetch_blocker(const global uint* blockers, uint mask, const global wt_candidate* candidate) {
  wt_prefetch(blockers + wt_blocker_slot(candidate->node, candidate->receiver, mask));
}
#define WT_BLOCKER_ARGUMENTS const global WT_LEAF *leaves, const global uint *blockers,
#define WT_BLOCKERS_GIVEN leaves, blockers,
#else
#define WT_BLOCKER_ARGUMENTS
#define WT_BLOCKERS_GIVEN
#endif

// Adds candidate i, unless it has no path, or what hid its path before still does.
inline void find_row(const wt_followed_sequence* s, const global double4* transmitters, const global double4* receivers,
                     const global wt_exact_surface* surfaces, const global double* triangles,
                     const global wt_exact_instance* instances, const global wt_candidate* candidates, uint i,
                     global wt_counters* counters, WT_BLOCKER_ARGUMENTS wt_solve_arguments args, wt_found_rows* rows) {
  const double4 to = receivers[candidates[i].receiver];
  // The vehicle that carries an antenna does not reflect for it, as it hides nothing from it.
  if (s->depth > 0) {
    const uint first = surfaces[s->chain[0]].instance, last = surfaces[s->chain[s->depth - 1]].instance;
    if ((first != WT_NONE && first == wt_end_instance(transmitters[s->transmitter])) ||
        (last != WT_NONE && last == wt_end_instance(to)))
      return;
  }
  double3* points = rows->points[rows->count];
  if (!wt_reflection_points(surfaces, triangles, instances, s->chain, s->depth, s->images, to.xyz, points)) return;
#ifdef WT_BLOCKERS
  if (hidden(leaves, args.triangle_slots, blockers, args.blocker_mask, surfaces, s->chain, s->depth, s->node,
             candidates[i].receiver, transmitters[s->transmitter], to, points)) {
    atomic_inc(&counters->hidden);
    return;
  }
#endif
  rows->candidate[rows->count++] = i;
}

// Writes the rows that were found to places that follow each other.
inline void write_rows(const global ulong* table, const global uint* quarters, const global double4* transmitters,
                       const global wt_exact_surface* surfaces, const global wt_candidate* candidates,
                       const wt_found_rows* rows, wt_followed_sequence* s, global wt_solved* solved,
                       global double* vertices, global uint* sequences, global wt_counters* counters,
                       wt_solve_arguments args) {
  const uint first = rows->count > 0 ? atomic_add(&counters->solved, rows->count) : 0;
  for (uint n = 0; n < rows->count && first + n < args.capacity; ++n) {
    const uint slot = first + n;
    const wt_candidate candidate = candidates[rows->candidate[n]];
    if (candidate.node != s->node) wt_follow(table, transmitters, surfaces, candidate.node, s);
    solved[slot].transmitter = s->transmitter;
    solved[slot].receiver = candidate.receiver;
    solved[slot].depth = s->depth;
    solved[slot].blocked = 0;
    solved[slot].node = candidate.node;
    solved[slot].quarters = wt_found_by(quarters, candidate.node);
    for (uint k = 0; k < s->depth; ++k) {
      const size_t at = (size_t)slot * args.max_depth + k;
      vstore3(rows->points[n][k], at, vertices);
      sequences[at] = s->chain[k];
    }
  }
}

// A work-item takes WT_TOGETHER candidates that follow each other, so that their paths follow each other, too.
kernel void solve(const global ulong* table, const global uint* quarters, const global double4* transmitters,
                  const global double4* receivers, const global wt_exact_surface* surfaces,
                  const global double* triangles, const global wt_exact_instance* instances,
                  const global wt_candidate* candidates, global wt_solved* solved, global double* vertices,
                  global uint* sequences, global wt_counters* counters, WT_BLOCKER_ARGUMENTS wt_solve_arguments args) {
  const uint count = min(args.candidate_count, counters->candidates), begin = WT_TOGETHER * get_global_id(0);
  if (begin >= count) return;
  const uint end = min(begin + WT_TOGETHER, count);
  wt_followed_sequence s;
  wt_found_rows rows;
  rows.count = 0;
  for (uint i = begin; i < end;) {
    prefetch_chains(table, candidates, i, count);
#ifdef WT_BLOCKERS
    if (i + WT_AHEAD < count) prefetch_blocker(blockers, args.blocker_mask, candidates + i + WT_AHEAD);
#endif
    if (i == begin || candidates[i].node != s.node) wt_follow(table, transmitters, surfaces, candidates[i].node, &s);
    uint left = 1u;
#if WT_TOGETHER > 1 && !defined(WT_BLOCKERS)
    const int run = wt_is_run(candidates, i, end);
    if (run) left = wt_find_rows8(&s, receivers, surfaces, triangles, candidates, i, &rows);
#else
    const int run = 0;
#endif
    for (uint k = 0; left; ++k, left >>= 1)
      if (left & 1u)
        find_row(&s, transmitters, receivers, surfaces, triangles, instances, candidates, i + k, counters,
                 WT_BLOCKERS_GIVEN args, &rows);
    i += run ? 8 : 1;
  }
  write_rows(table, quarters, transmitters, surfaces, candidates, &rows, &s, solved, vertices, sequences, counters,
             args);
}
