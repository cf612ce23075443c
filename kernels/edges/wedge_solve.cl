// SPDX-License-Identifier: Apache-2.0
// wedge_solve: diffracted paths in double. It computes the points on the edges first, from the images of both ends,
// then the reflections between each end and its edge. It keeps paths whose points are inside edges and surfaces, in the
// free sector of each wedge. Legs are not tested here (occlusion does that). On CPUs a work-item takes a run of
// candidates, so that their paths follow each other.
#include "lib/bend_bound.clh"
#include "lib/fermat.clh"
#include "lib/reflections.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// Candidates of a work-item, and the most interactions of a path.
#ifndef WT_TOGETHER
#define WT_TOGETHER 1u
#define WT_ROOM WT_MAX_DEPTH
#endif

// A way from an end by mirrors. Candidates that follow each other share it, or its chain.
typedef struct {
  uint node, depth, root, chain[WT_MAX_DEPTH];
  double4 end;
  double3 images[WT_MAX_DEPTH + 1];
} wt_way;

inline void take_way(const global ulong* table, const global wt_exact_surface* surfaces, uint node, int is_first,
                     const global double4* ends, uint end, wt_way* way) {
  const int same = !is_first && way->node == node;
  if (!same) {
    way->node = node;
    way->depth = wt_chain(table, node, way->chain, &way->root);
  }
  const double4 at = ends[end == WT_NONE ? way->root : end];
  if (same && all(way->end == at)) return;
  way->end = at;
  way->images[0] = at.xyz;
  for (uint k = 0; k < way->depth; ++k) way->images[k + 1] = wt_reflected(surfaces + way->chain[k], way->images[k]);
}

// Rows that are found, before their places are known.
typedef struct {
  uint count, transmitter[WT_TOGETHER], receiver[WT_TOGETHER], quarters[WT_TOGETHER], depth[WT_TOGETHER];
  uint steps[WT_TOGETHER][WT_ROOM];
  double3 points[WT_TOGETHER][WT_ROOM];
} wt_bent_rows;

inline int own_instance(uint instance, double4 end) { return instance != WT_NONE && instance == wt_end_instance(end); }

// Solves the reflections between an end and its edge; 0 where that is no path. An antenna's vehicle is no mirror or
// wedge for it.
inline int solve_side(const global wt_exact_surface* surfaces, const global double* triangles,
                      const global wt_exact_instance* instances, const global wt_wedge* w, const uint* chain,
                      uint depth, double4 end, const double3* images, double3 p, double3* points) {
  if (own_instance(depth > 0 ? surfaces[chain[0]].instance : w->instance, end)) return 0;
  if (depth > 0 && fabs(wt_above(surfaces + chain[depth - 1], p)) <= WT_AT_EDGE_M) return 0;
  if (!wt_reflection_points(surfaces, triangles, instances, chain, depth, images, p, points)) return 0;
  return wt_in_free_space(w, p, depth > 0 ? points[depth - 1] : images[0], wt_beneath(depth));
}

// Begins to read the chains of the candidates that follow candidate i.
inline void prefetch_chains(const global ulong* table, const global wt_wedge_candidate* candidates, uint i,
                            uint count) {
  for (uint step = 0; WT_AHEAD > 1 && step < 3 && i + (WT_AHEAD >> step) < count; ++step) {
    wt_chain_prefetch(table, candidates[i + (WT_AHEAD >> step)].node, step);
    wt_chain_prefetch(table, candidates[i + (WT_AHEAD >> step)].back, step);
  }
}

// Is a path from image a over the point p of an edge to image b surely weaker than the floor? floor: a power, divided
// by those of all constant factors. Paths over free ends have no floor.
inline int is_weak_over_one(const global wt_wedge* v, double3 a, double3 b, double3 p, double floor,
                            double wavelength) {
  if (v->free_ends != 0u) return 0;
  const double3 at = wt_in_wedge(v, a);
  const double before_m = sqrt(wt_dot(p - a, p - a)), after_m = sqrt(wt_dot(b - p, b - p)), off_m = wt_from_edge(at);
  const double sine = off_m / before_m, spread_m = before_m * after_m * sine * sine / (before_m + after_m);
  const double most = wt_bend_between(v, at, wt_in_wedge(v, b), spread_m, wavelength, 1).amplitude;
  return most * most < floor * (before_m * after_m * (before_m + after_m) * sine * sine);
}

// The same over the points p and q of two edges. Paths along a plane of both have no floor.
inline int is_weak_over_two(const global wt_wedge* v, const global wt_wedge* w, double3 a, double3 b, double3 p,
                            double3 q, double floor, double wavelength) {
  if (wt_share_plane(v, w, (double3)(0.0, 0.0, 0.0))) return 0;
  const double3 from = wt_in_wedge(v, a), to = wt_in_wedge(w, b);
  const double before_m = sqrt(wt_dot(p - a, p - a)), between_m = sqrt(wt_dot(q - p, q - p)),
               after_m = sqrt(wt_dot(b - q, b - q));
  const double sine_v = wt_from_edge(from) / before_m, sine_w = wt_from_edge(to) / after_m;
  const double spread_v = before_m * between_m / (before_m + between_m) * sine_v * sine_v;
  const double spread_w = after_m * between_m / (after_m + between_m) * sine_w * sine_w;
  const wt_bend_bound first = wt_bend_between(v, from, wt_in_wedge(v, q), spread_v, wavelength, 0);
  const wt_bend_bound second = wt_bend_between(w, to, wt_in_wedge(w, p), spread_w, wavelength, 0);
  const double pair = first.argument * second.argument > WT_FAR_EDGES ? WT_FAR_PAIR_BOUND : WT_PAIR_BOUND;
  const double most = first.amplitude * second.amplitude * pair;
  const double sines = sine_v * sine_w;
  return most * most < floor * (before_m * between_m * after_m * (before_m + between_m + after_m) * sines * sines);
}

// The same for one edge or two; w: the second one, or null.
inline int is_weak(const global wt_wedge* v, const global wt_wedge* w, double3 a, double3 b, double3 p, double3 q,
                   const wt_solve_arguments* args) {
  if (args->floors[w != 0] == 0.0) return 0;
  return w ? is_weak_over_two(v, w, a, b, p, q, args->floors[1], (double)args->wavelength_m)
           : is_weak_over_one(v, a, b, p, args->floors[0], (double)args->wavelength_m);
}

// Adds a candidate, unless it has no path. to: the way from the receiver.
inline void solve_candidate(const global wt_exact_surface* surfaces, const global double* triangles,
                            const global wt_exact_instance* instances, const global wt_wedge* wedges,
                            const wt_wedge_candidate c, const wt_way* from, const wt_way* to,
                            const wt_solve_arguments* args, wt_bent_rows* rows) {
  const uint depth = from->depth, back = to->depth;
  const double3 a = from->images[depth], b = to->images[back];
  const global wt_wedge* v = wedges + c.wedges[0];
  const int two = c.wedges[1] != WT_NONE;
  const global wt_wedge* w = two ? wedges + c.wedges[1] : v;
  double x, y;
  if (two) {
    if (!wt_shortest_over_two(v, w, a, b, &x, &y)) return;
  } else {
    x = y = wt_shortest_over(v, a, b);
  }
  const double wavelength = (double)args->wavelength_m;
  if (!two && v->free_ends != 0u) x = y = wt_at_free_end(v, x, wt_in_wedge(v, a), wt_in_wedge(v, b), wavelength);
  if (!wt_within_edge(v, x) || !wt_within_edge(w, y)) return;
  const double3 p = wt_on_edge(v, x), q = wt_on_edge(w, y);
  if (two && wt_dot(q - p, q - p) <= WT_AT_EDGE_M * WT_AT_EDGE_M) return;  // edges that meet, at their corner
  if (wt_is_faint(v, wt_in_wedge(v, a), wt_in_wedge(v, two ? q : b), wavelength)) return;
  if (two && wt_is_faint(w, wt_in_wedge(w, p), wt_in_wedge(w, b), wavelength)) return;
  if (two && !wt_share_plane(v, w, q - p) && (!wt_in_free_space(v, p, q, 0.0) || !wt_in_free_space(w, q, p, 0.0)))
    return;
  if (is_weak(v, two ? w : 0, a, b, p, q, args)) return;
  double3 *points = rows->points[rows->count], back_points[WT_MAX_DEPTH];
  if (!solve_side(surfaces, triangles, instances, v, from->chain, depth, from->end, from->images, p, points)) return;
  if (!solve_side(surfaces, triangles, instances, w, to->chain, back, to->end, to->images, q, back_points)) return;

  const uint row = rows->count++, diffractions = two ? 2 : 1;
  rows->transmitter[row] = from->root;
  rows->receiver[row] = c.receiver;
  rows->quarters[row] = c.quarters;
  rows->depth[row] = depth + diffractions + back;
  uint at = 0;
  for (uint k = 0; k < depth; ++k, ++at) {
    rows->steps[row][at] = WT_STEP_REFLECTION | from->chain[k];
  }
  for (uint k = 0; k < diffractions; ++k, ++at) {
    rows->points[row][at] = k == 0 ? p : q;
    rows->steps[row][at] = WT_STEP_DIFFRACTION | c.wedges[k];
  }
  for (uint k = back; k-- > 0; ++at) {
    rows->points[row][at] = back_points[k];
    rows->steps[row][at] = WT_STEP_REFLECTION | to->chain[k];
  }
}

kernel void wedge_solve(const global ulong* table, const global double4* origins, const global double4* receivers,
                        const global wt_exact_surface* surfaces, const global double* triangles,
                        const global wt_exact_instance* instances, const global wt_wedge* wedges,
                        const global wt_wedge_candidate* candidates, global wt_solved* solved, global double* vertices,
                        global uint* sequences, global wt_counters* counters, wt_solve_arguments args) {
  const uint count = min(args.candidate_count, counters->wedge_candidates), begin = WT_TOGETHER * get_global_id(0);
  if (begin >= count) return;
  const uint end = min(begin + WT_TOGETHER, count);
  wt_way from, to;
  wt_bent_rows rows;
  rows.count = 0;
  for (uint i = begin; i < end; ++i) {
    prefetch_chains(table, candidates, i, count);
    const wt_wedge_candidate c = candidates[i];
    take_way(table, surfaces, c.node, i == begin, origins, WT_NONE, &from);
    take_way(table, surfaces, c.back, i == begin, receivers, c.receiver, &to);
    solve_candidate(surfaces, triangles, instances, wedges, c, &from, &to, &args, &rows);
  }
  const uint first = rows.count > 0 ? atomic_add(&counters->wedge_solved, rows.count) : 0;
  for (uint n = 0; n < rows.count && first + n < args.capacity; ++n) {
    const uint slot = first + n;
    solved[slot].transmitter = rows.transmitter[n];
    solved[slot].receiver = rows.receiver[n];
    solved[slot].depth = rows.depth[n];
    solved[slot].blocked = 0;
    solved[slot].node = WT_NONE;
    solved[slot].quarters = rows.quarters[n];
    for (uint k = 0; k < rows.depth[n]; ++k) {
      vstore3(rows.points[n][k], (size_t)slot * args.max_depth + k, vertices);
      sequences[(size_t)slot * args.max_depth + k] = rows.steps[n][k];
    }
  }
}
