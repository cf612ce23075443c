// SPDX-License-Identifier: Apache-2.0
// wedge_solve: diffracted paths in double. It computes the points on the edges first, from the images of both ends,
// then the reflections between each end and its edge. It keeps paths whose points are inside edges and surfaces, in the
// free sector of each wedge. Legs are not tested here (occlusion does that).
#include "lib/bend_bound.clh"
#include "lib/fermat.clh"
#include "lib/reflections.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

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

kernel void wedge_solve(const global ulong* table, const global double4* origins, const global double4* receivers,
                        const global wt_exact_surface* surfaces, const global double* triangles,
                        const global wt_exact_instance* instances, const global wt_wedge* wedges,
                        const global wt_wedge_candidate* candidates, global wt_solved* solved, global double* vertices,
                        global uint* sequences, global wt_counters* counters, wt_solve_arguments args) {
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
  const global wt_wedge* v = wedges + c.wedges[0];
  const int two = c.wedges[1] != WT_NONE;
  const global wt_wedge* w = two ? wedges + c.wedges[1] : v;
  double x, y;
  if (two) {
    if (!wt_shortest_over_two(v, w, a, b, &x, &y)) return;
  } else {
    x = y = wt_shortest_over(v, a, b);
  }
  if (!two && v->free_ends != 0u) x = y = wt_at_free_end(v, x, wt_in_wedge(v, a), wt_in_wedge(v, b), args.wavelength_m);
  if (!wt_within_edge(v, x) || !wt_within_edge(w, y)) return;
  const double3 p = wt_on_edge(v, x), q = wt_on_edge(w, y);
  if (two && wt_dot(q - p, q - p) <= WT_AT_EDGE_M * WT_AT_EDGE_M) return;  // edges that meet, at their corner
  const double wavelength = (double)args.wavelength_m;
  if (wt_is_faint(v, wt_in_wedge(v, a), wt_in_wedge(v, two ? q : b), wavelength)) return;
  if (two && wt_is_faint(w, wt_in_wedge(w, p), wt_in_wedge(w, b), wavelength)) return;
  if (two && !wt_share_plane(v, w, q - p) && (!wt_in_free_space(v, p, q, 0.0) || !wt_in_free_space(w, q, p, 0.0)))
    return;
  if (is_weak(v, two ? w : 0, a, b, p, q, &args)) return;
  if (!solve_side(surfaces, triangles, instances, v, chain, depth, from, images, p, points)) return;
  if (!solve_side(surfaces, triangles, instances, w, back_chain, back, to, back_images, q, back_points)) return;

  const uint slot = atomic_inc(&counters->wedge_solved);
  if (slot >= args.capacity) return;
  const uint diffractions = two ? 2 : 1, total = depth + diffractions + back;
  solved[slot].transmitter = transmitter;
  solved[slot].receiver = c.receiver;
  solved[slot].depth = total;
  solved[slot].blocked = 0;
  solved[slot].node = WT_NONE;
  solved[slot].quarters = c.quarters;
  size_t at = (size_t)slot * args.max_depth;
  for (uint k = 0; k < depth; ++k, ++at) {
    vstore3(points[k], at, vertices);
    sequences[at] = WT_STEP_REFLECTION | chain[k];
  }
  for (uint k = 0; k < diffractions; ++k, ++at) {
    vstore3(k == 0 ? p : q, at, vertices);
    sequences[at] = WT_STEP_DIFFRACTION | c.wedges[k];
  }
  for (uint k = back; k-- > 0; ++at) {
    vstore3(back_points[k], at, vertices);
    sequences[at] = WT_STEP_REFLECTION | back_chain[k];
  }
}
