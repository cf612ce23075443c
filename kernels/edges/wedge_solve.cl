// SPDX-License-Identifier: Apache-2.0
// wedge_solve: diffracted paths in double. It computes the points on the edges first, from the images of both ends,
// then the reflections between each end and its edge. It keeps paths whose points are inside edges and surfaces, in the
// free sector of each wedge. Legs are not tested here (occlusion does that). Paths below floors are left out:
// link_floors to materials_of have those of links (lib/weak_bends.clh), and are null without them. On CPUs a work-item
// takes a run of candidates, so that their paths follow each other.
#include "lib/fermat.clh"
#include "lib/reflections.clh"
#include "lib/weak_bends.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// Candidates of a work-item.
#ifndef WT_TOGETHER
#define WT_TOGETHER 1u
#endif

inline double3 images_of(const global wt_exact_surface* surfaces, const uint* chain, uint depth, double3 end,
                         double3* images) {
  images[0] = end;
  for (uint k = 0; k < depth; ++k) images[k + 1] = wt_reflected(surfaces + chain[k], images[k]);
  return images[depth];
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

// Finds the points of the shortest way from image a over the edges v and w, or over v alone if w is null, to image b.
// Returns 0 where there is no path.
inline int find_points_on_edges(const global wt_wedge* v, const global wt_wedge* w, double3 a, double3 b,
                                const wt_solve_arguments* args, double3* on_edges) {
  const int two = w != 0;
  const double wavelength = (double)args->wavelength_m;
  double x, y;
  if (!two) {
    w = v;
    x = y = wt_shortest_over(v, a, b);
  } else if (!wt_shortest_over_two(v, w, a, b, &x, &y)) {
    return 0;
  }
  if (!two && v->free_ends != 0u) x = y = wt_at_free_end(v, x, wt_in_wedge(v, a), wt_in_wedge(v, b), wavelength);
  if (!wt_within_edge(v, x) || !wt_within_edge(w, y)) return 0;
  const double3 p = wt_on_edge(v, x), q = wt_on_edge(w, y);
  if (two && wt_dot(q - p, q - p) <= WT_AT_EDGE_M * WT_AT_EDGE_M) return 0;  // edges that meet, at their corner
  if (wt_is_faint(v, wt_in_wedge(v, a), wt_in_wedge(v, two ? q : b), wavelength)) return 0;
  if (two && wt_is_faint(w, wt_in_wedge(w, p), wt_in_wedge(w, b), wavelength)) return 0;
  if (two && !wt_share_plane(v, w, q - p) && (!wt_in_free_space(v, p, q, 0.0) || !wt_in_free_space(w, q, p, 0.0)))
    return 0;
  on_edges[0] = p;
  on_edges[1] = q;
  return 1;
}

// Is a path over these points of the edges surely weaker than its floors? chain, a: the mirrors before them, and the
// transmitter's image in those; back_chain, b: the same after them, from the receiver on.
inline int is_weak(const global wt_exact_surface* surfaces, const global wt_wedge* v, const global wt_wedge* w,
                   const uint* chain, uint depth, double3 a, const uint* back_chain, uint back, double3 b,
                   const double3* on_edges, const wt_link_tables* links, wt_link_limit link,
                   const wt_solve_arguments* args) {
  double kept = 1.0;
  if (link.floor > 0.0)
    kept = wt_kept_by_mirrors(links, surfaces, chain, depth, a, on_edges[0]) *
           wt_kept_by_mirrors(links, surfaces, back_chain, back, b, on_edges[w ? 1 : 0]);
  return wt_is_weak(v, w, a, b, on_edges[0], on_edges[1], kept, link, args);
}

#if WT_TOGETHER > 1
#include "lib/bent_rows.clh"
#endif

kernel void wedge_solve(const global ulong* table, const global double4* origins, const global double4* receivers,
                        const global wt_exact_surface* surfaces, const global double* triangles,
                        const global wt_exact_instance* instances, const global wt_wedge* wedges,
                        const global wt_wedge_candidate* candidates, const global float* link_floors,
                        volatile global uint* left_out, const global float* reflectances,
                        const global uint* materials_of, global wt_solved* solved, global double* vertices,
                        global uint* sequences, global wt_counters* counters, wt_solve_arguments args) {
  const wt_link_tables links = {link_floors, left_out, reflectances, materials_of};
#if WT_TOGETHER > 1
  solve_run(table, origins, receivers, surfaces, triangles, instances, wedges, candidates, &links, solved, vertices,
            sequences, counters, &args);
#else
  const uint i = get_global_id(0), count = min(args.candidate_count, counters->wedge_candidates);
  if (i >= count) return;
  prefetch_chains(table, candidates, i, count);
  const wt_wedge_candidate c = candidates[i];
  uint chain[WT_MAX_DEPTH], back_chain[WT_MAX_DEPTH], transmitter, origin;
  double3 images[WT_MAX_DEPTH + 1], points[WT_MAX_DEPTH], back_images[WT_MAX_DEPTH + 1], back_points[WT_MAX_DEPTH];
  const uint depth = wt_chain(table, c.node, chain, &transmitter), back = wt_chain(table, c.back, back_chain, &origin);
  const double4 from = origins[transmitter], to = receivers[c.receiver];
  const double3 a = images_of(surfaces, chain, depth, from.xyz, images);
  const double3 b = images_of(surfaces, back_chain, back, to.xyz, back_images);
  const uint diffractions = c.wedges[1] != WT_NONE ? 2 : 1;
  const global wt_wedge *v = wedges + c.wedges[0], *w = wedges + c.wedges[diffractions - 1];
  double3 on_edges[2];
  const wt_link_limit link = wt_limit_of(&links, transmitter, c.receiver, &args);
  const global wt_wedge* second = diffractions > 1 ? w : 0;
  if (!find_points_on_edges(v, second, a, b, &args, on_edges)) return;
  if (is_weak(surfaces, v, second, chain, depth, a, back_chain, back, b, on_edges, &links, link, &args)) return;
  if (!solve_side(surfaces, triangles, instances, v, chain, depth, from, images, on_edges[0], points)) return;
  if (!solve_side(surfaces, triangles, instances, w, back_chain, back, to, back_images, on_edges[1], back_points))
    return;
  const uint slot = atomic_inc(&counters->wedge_solved);
  if (slot >= args.capacity) return;
  solved[slot].transmitter = transmitter;
  solved[slot].receiver = c.receiver;
  solved[slot].depth = depth + diffractions + back;
  solved[slot].blocked = 0;
  solved[slot].node = WT_NONE;
  solved[slot].quarters = c.quarters;
  size_t at = (size_t)slot * args.max_depth;
  for (uint k = 0; k < depth; ++k, ++at) {
    vstore3(points[k], at, vertices);
    sequences[at] = WT_STEP_REFLECTION | chain[k];
  }
  for (uint k = 0; k < diffractions; ++k, ++at) {
    vstore3(on_edges[k], at, vertices);
    sequences[at] = WT_STEP_DIFFRACTION | c.wedges[k];
  }
  for (uint k = back; k-- > 0; ++at) {
    vstore3(back_points[k], at, vertices);
    sequences[at] = WT_STEP_REFLECTION | back_chain[k];
  }
#endif
}
