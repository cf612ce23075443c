// SPDX-License-Identifier: Apache-2.0
// transmissions: enters the surfaces that the legs of a solved path pass through into its row, as interactions. Waves
// go straight on, so a path with transmissions is a path without them whose legs are obstructed; lib/legs.clh says by
// what. Consumes solved paths; rewrites their rows, or sets wt_solved::blocked where a path may not pass that many.
#include "lib/count.clh"
#include "lib/legs.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

typedef struct {
  double3 point;
  double along;  // share of its leg
  uint surface, leg;
} wt_crossing;

// Does a crossing lie in the plane of a surface that faces the same way? Then both surfaces are one wall there, as
// where two buildings touch, or at the border of two patches.
inline int one_wall(const global wt_exact_surface* surfaces, const wt_crossing* c, uint surface) {
  const global wt_exact_surface* s = surfaces + surface;
  const double cosine = wt_dot(wt_normal(surfaces + c->surface), wt_normal(s));
  return cosine * cosine > 1.0 - 1e-6 && fabs(wt_above(s, c->point)) <= WT_ON_SURFACE_M;
}

inline double3 middle(const global wt_surface* s) {
  return 0.5 * (double3)((double)s->lower[0] + s->upper[0], (double)s->lower[1] + s->upper[1],
                         (double)s->lower[2] + s->upper[2]);
}

// Is surface b on the far side of the plane of a, as seen from a point?
inline int behind(const global wt_exact_surface* a, const global wt_surface* b, double3 from) {
  return (wt_above(a, from) > 0.0) != (wt_above(a, middle(b)) > 0.0);
}

// Does the leg pass a before b? Beside the edge of a solid, float32 may find that a leg passes both of its faces
// although it misses them in double. Then it crosses their planes in the wrong order, and the places of the surfaces
// decide.
inline int passes_before(const global wt_exact_surface* surfaces, const global wt_surface* boxes, const wt_leg* l,
                         const wt_crossing* a, const wt_crossing* b) {
  const double3 apart = a->point - b->point;
  if (wt_dot(apart, apart) <= WT_ON_SURFACE_M * WT_ON_SURFACE_M) {
    const int behind_a = behind(surfaces + a->surface, boxes + b->surface, l->from.p);
    const int behind_b = behind(surfaces + b->surface, boxes + a->surface, l->from.p);
    if (behind_a != behind_b) return behind_a;
  }
  return a->along < b->along;
}

// Enters the crossings, the last one of the path first, into its row.
inline void enter(global wt_solved* path, global double* v, global uint* s, const wt_crossing* crossings, uint count) {
  const uint depth = path->depth;
  // The row is written from its end, so that nothing is overwritten before it has moved.
  uint to = depth + count, next = 0;
  path->depth = to;
  for (uint from = depth; next < count;) {
    if (crossings[next].leg == from) {
      --to;
      v[3 * to] = crossings[next].point.x;
      v[3 * to + 1] = crossings[next].point.y;
      v[3 * to + 2] = crossings[next].point.z;
      s[to] = WT_STEP_TRANSMISSION | crossings[next].surface;
      ++next;
    } else {
      --from;
      --to;
      for (uint axis = 0; axis < 3; ++axis) v[3 * to + axis] = v[3 * from + axis];
      s[to] = s[from];
    }
  }
}

// One path per work-item. most: the most transmissions of a path; deepest: the most interactions of all kinds in a path
// with transmissions. A row has room for that many. Open rows end at their last vertex.
kernel void transmissions(const global WT_NODE* nodes, const global WT_LEAF* triangles, const global float4* moving,
                          const global double4* transmitters, const global double4* receivers,
                          const global wt_exact_surface* surfaces, const global double* corners,
                          const global wt_surface* boxes, global wt_solved* solved, global double* vertices,
                          global uint* sequences, const global wt_wedge* wedges, const global uint* surface_of_tile,
                          const global wt_target_point* targets, const global wt_counters* counters,
                          wt_legs_arguments args) {
  const uint i = get_global_id(0);
  if (i >= wt_length(counters, args.solved_counter, args.solved_count)) return;
  const uint depth = solved[i].depth, allowed = depth < args.deepest ? min(args.most, args.deepest - depth) : 0;
  global double* v = vertices + 3 * (size_t)args.max_depth * i;
  global uint* s = sequences + (size_t)args.max_depth * i;
  const wt_step_tables tables = {surfaces, wedges, surface_of_tile, args.tile_count, targets};
  wt_crossing crossings[WT_MAX_DEPTH];  // the last one of the path first
  uint count = 0;
  for (uint after = args.open; after <= depth; ++after) {
    const uint leg = depth - after;
    wt_leg l;
    wt_leg_of(&tables, solved + i, leg, v, s, transmitters, receivers, &l);
    const uint first = count;
    wt_walk walk;
    wt_walk_from_start(&l, &walk);
    uint tries = 0, turned = 0;
    for (;;) {
      const uint surface =
          wt_next_blocking(nodes, triangles, args.triangle_slots, args.extent_m, moving, surfaces, corners, &l, &walk);
      if (surface == WT_NONE) break;
      // This is the same as in wt_obstructed.
      const int aside = tries < WT_RIM_TRIES &&
                        wt_step_aside(triangles, args.triangle_slots, corners, walk.place, surfaces + surface, &l);
      if (aside || (!turned && wt_take_other_side(&l))) {
        tries += aside;
        turned |= !aside;
        count = first;
        wt_walk_from_start(&l, &walk);
        continue;
      }
      uint known = first;
      while (known < count && !one_wall(surfaces, crossings + known, surface)) ++known;
      if ((known == count && count == allowed) || surfaces[surface].opaque) {
        solved[i].blocked = 1;
        return;
      }
      const double a = wt_above(surfaces + surface, l.from.p), b = wt_above(surfaces + surface, l.to.p);
      const double u = fmin(fmax(a / (a - b), 0.0), 1.0);
      // Distances of the traversal are float32: if two walls are near each other, it may find the second one first.
      const wt_crossing c = {l.from.p + u * (l.to.p - l.from.p), u, surface, leg};
      if (known < count) {  // the lowest surface stands for the wall, even if float32 meets another one first
        if (surface < crossings[known].surface) crossings[known] = c;
        continue;
      }
      uint k = count++;
      for (; k > first && !passes_before(surfaces, boxes, &l, &c, crossings + k - 1); --k)
        crossings[k] = crossings[k - 1];
      crossings[k] = c;
    }
  }
  enter(solved + i, v, s, crossings, count);
}
