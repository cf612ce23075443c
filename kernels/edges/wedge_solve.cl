// SPDX-License-Identifier: Apache-2.0
// wedge_solve: diffracted paths in double. It computes the points on the edges first, from the images of both ends,
// then the reflections between each end and its edge. It keeps paths whose points are inside edges and surfaces, in the
// free sector of each wedge. Legs are not tested here (occlusion does that). On CPUs a work-item takes a run of
// candidates, so that their paths follow each other.
#include "lib/fermat.clh"
#include "lib/reflections.clh"
#include "lib/weak_bends.clh"
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

// Finds the points of the path of a candidate: those on its edges, and those of the reflections on either side. to: the
// way from the receiver. Returns 0 where there is no path.
inline int solve_candidate(const global wt_exact_surface* surfaces, const global double* triangles,
                           const global wt_exact_instance* instances, const global wt_wedge* wedges,
                           const wt_wedge_candidate c, const wt_way* from, const wt_way* to,
                           const wt_solve_arguments* args, double3* on_edges, double3* points, double3* back_points) {
  const uint depth = from->depth, back = to->depth;
  const double3 a = from->images[depth], b = to->images[back];
  const global wt_wedge* v = wedges + c.wedges[0];
  const int two = c.wedges[1] != WT_NONE;
  const global wt_wedge* w = two ? wedges + c.wedges[1] : v;
  double x, y;
  if (two) {
    if (!wt_shortest_over_two(v, w, a, b, &x, &y)) return 0;
  } else {
    x = y = wt_shortest_over(v, a, b);
  }
  const double wavelength = (double)args->wavelength_m;
  if (!two && v->free_ends != 0u) x = y = wt_at_free_end(v, x, wt_in_wedge(v, a), wt_in_wedge(v, b), wavelength);
  if (!wt_within_edge(v, x) || !wt_within_edge(w, y)) return 0;
  const double3 p = wt_on_edge(v, x), q = wt_on_edge(w, y);
  if (two && wt_dot(q - p, q - p) <= WT_AT_EDGE_M * WT_AT_EDGE_M) return 0;  // edges that meet, at their corner
  if (wt_is_faint(v, wt_in_wedge(v, a), wt_in_wedge(v, two ? q : b), wavelength)) return 0;
  if (two && wt_is_faint(w, wt_in_wedge(w, p), wt_in_wedge(w, b), wavelength)) return 0;
  if (two && !wt_share_plane(v, w, q - p) && (!wt_in_free_space(v, p, q, 0.0) || !wt_in_free_space(w, q, p, 0.0)))
    return 0;
  if (wt_is_weak(v, two ? w : 0, a, b, p, q, args)) return 0;
  if (!solve_side(surfaces, triangles, instances, v, from->chain, depth, from->end, from->images, p, points)) return 0;
  if (!solve_side(surfaces, triangles, instances, w, to->chain, back, to->end, to->images, q, back_points)) return 0;
  on_edges[0] = p;
  on_edges[1] = q;
  return 1;
}

inline uint edges_of(const wt_wedge_candidate* c) { return c->wedges[1] != WT_NONE ? 2 : 1; }

#if WT_TOGETHER > 1
// Rows that are found, before their places are known.
typedef struct {
  uint count, transmitter[WT_TOGETHER], receiver[WT_TOGETHER], quarters[WT_TOGETHER], depth[WT_TOGETHER];
  uint steps[WT_TOGETHER][WT_ROOM];
  double3 points[WT_TOGETHER][WT_ROOM];
} wt_bent_rows;

// Keeps the row of a path, whose first points are in their places already.
inline void keep_row(const wt_wedge_candidate* c, const wt_way* from, const wt_way* to, const double3* on_edges,
                     const double3* back_points, wt_bent_rows* rows) {
  const uint row = rows->count++;
  rows->transmitter[row] = from->root;
  rows->receiver[row] = c->receiver;
  rows->quarters[row] = c->quarters;
  rows->depth[row] = from->depth + edges_of(c) + to->depth;
  uint at = 0;
  for (; at < from->depth; ++at) rows->steps[row][at] = WT_STEP_REFLECTION | from->chain[at];
  for (uint k = 0; k < edges_of(c); ++k, ++at) {
    rows->points[row][at] = on_edges[k];
    rows->steps[row][at] = WT_STEP_DIFFRACTION | c->wedges[k];
  }
  for (uint k = to->depth; k-- > 0; ++at) {
    rows->points[row][at] = back_points[k];
    rows->steps[row][at] = WT_STEP_REFLECTION | to->chain[k];
  }
}
#else
// Writes the row of a path.
inline void write_row(const wt_wedge_candidate* c, const wt_way* from, const wt_way* to, const double3* on_edges,
                      const double3* points, const double3* back_points, size_t at, global wt_solved* row,
                      global double* vertices, global uint* sequences) {
  row->transmitter = from->root;
  row->receiver = c->receiver;
  row->depth = from->depth + edges_of(c) + to->depth;
  row->blocked = 0;
  row->node = WT_NONE;
  row->quarters = c->quarters;
  for (uint k = 0; k < from->depth; ++k, ++at) {
    vstore3(points[k], at, vertices);
    sequences[at] = WT_STEP_REFLECTION | from->chain[k];
  }
  for (uint k = 0; k < edges_of(c); ++k, ++at) {
    vstore3(on_edges[k], at, vertices);
    sequences[at] = WT_STEP_DIFFRACTION | c->wedges[k];
  }
  for (uint k = to->depth; k-- > 0; ++at) {
    vstore3(back_points[k], at, vertices);
    sequences[at] = WT_STEP_REFLECTION | to->chain[k];
  }
}
#endif

kernel void wedge_solve(const global ulong* table, const global double4* origins, const global double4* receivers,
                        const global wt_exact_surface* surfaces, const global double* triangles,
                        const global wt_exact_instance* instances, const global wt_wedge* wedges,
                        const global wt_wedge_candidate* candidates, global wt_solved* solved, global double* vertices,
                        global uint* sequences, global wt_counters* counters, wt_solve_arguments args) {
  const uint count = min(args.candidate_count, counters->wedge_candidates), begin = WT_TOGETHER * get_global_id(0);
  if (begin >= count) return;
  wt_way from, to;
  double3 on_edges[2], back_points[WT_MAX_DEPTH];
#if WT_TOGETHER > 1
  const uint end = min(begin + WT_TOGETHER, count);
  wt_bent_rows rows;
  rows.count = 0;
  for (uint i = begin; i < end; ++i) {
    prefetch_chains(table, candidates, i, count);
    const wt_wedge_candidate c = candidates[i];
    take_way(table, surfaces, c.node, i == begin, origins, WT_NONE, &from);
    take_way(table, surfaces, c.back, i == begin, receivers, c.receiver, &to);
    if (solve_candidate(surfaces, triangles, instances, wedges, c, &from, &to, &args, on_edges, rows.points[rows.count],
                        back_points))
      keep_row(&c, &from, &to, on_edges, back_points, &rows);
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
#else
  prefetch_chains(table, candidates, begin, count);
  const wt_wedge_candidate c = candidates[begin];
  double3 points[WT_MAX_DEPTH];
  take_way(table, surfaces, c.node, 1, origins, WT_NONE, &from);
  take_way(table, surfaces, c.back, 1, receivers, c.receiver, &to);
  if (!solve_candidate(surfaces, triangles, instances, wedges, c, &from, &to, &args, on_edges, points, back_points))
    return;
  const uint slot = atomic_inc(&counters->wedge_solved);
  if (slot < args.capacity)
    write_row(&c, &from, &to, on_edges, points, back_points, (size_t)slot * args.max_depth, solved + slot, vertices,
              sequences);
#endif
}
