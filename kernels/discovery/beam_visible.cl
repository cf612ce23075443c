// SPDX-License-Identifier: Apache-2.0
// beam_visible: the parts of facets that an image sees through an aperture and that nothing hides. Each part enters its
// sequence into the trie and becomes an aperture of the next depth, unless this is the last one. One candidate of one
// aperture per work-item; the other candidates of the aperture are what may hide it.
#include "lib/hider.clh"
#include "lib/pieces.clh"
#include "lib/trie.clh"
#pragma OPENCL FP_CONTRACT OFF

// A facet that is looked at: the plane of its surface, n . p = height from the image on, with axes (u, v) from the foot
// of the image; and its box in the view.
typedef struct {
  double3 n, u, v;
  double height;
  wt_view_box box;
  uint surface;
} wt_target;

inline wt_half_plane side_of(const wt_target* t, double3 n, double c) {
  return (wt_half_plane){wt_dot3(n, t->u), wt_dot3(n, t->v), wt_dot3(n, t->n) * t->height - c};
}

inline double3 point_of(const wt_target* t, double u, double v) { return t->n * t->height + t->u * u + t->v * v; }

// The part of a facet, moved into the plane of its surface, that the beam meets.
inline void lit_part(const global wt_aperture* aperture, const wt_view* view, double3 apex, const wt_outline* o,
                     const wt_target* target, wt_polygon* out) {
  wt_cone beam;
  wt_view_box all;
  wt_beam_through(aperture, view, apex, &beam, &all);
  wt_polygon other;
  out->count = 0;
  for (uint i = 0; i < o->count; ++i) wt_add_corner(out, wt_dot3(target->u, o->at[i]), wt_dot3(target->v, o->at[i]));
  for (uint k = 0; k < beam.count && out->count > 0; ++k) {
    const wt_half_plane side = side_of(target, beam.n[k], beam.c[k]);
    wt_cut(out, &side, &other);
    wt_copy_polygon(&other, out);
  }
}

// The box of a polygon in the view, all of which lies beyond the mirror.
inline void set_box(const wt_view* view, wt_target* target, const wt_polygon* p) {
  wt_empty_box(&target->box);
  for (uint i = 0; i < p->count; ++i) wt_widen_box(view, point_of(target, p->u[i], p->v[i]), &target->box);
}

// Does a candidate's box show that it hides nothing of a target: beside it, or beyond it?
inline int apart(const global wt_beam_candidate* c, const wt_view_box* box) {
  return c->nearest < box->farthest || c->high_u < box->low_u || c->low_u > box->high_u || c->high_v < box->low_v ||
         c->low_v > box->high_v;
}

// The lines that bound what a facet hides of a polygon; 0 if it hides nothing. Nothing in the plane of the target does.
inline int shadow_of(const global wt_facet* facet, const global double* corners, const wt_view* view, double3 apex,
                     const wt_target* target, const wt_polygon* p, wt_shadow* shadow) {
  wt_outline o;
  wt_load_outline(facet, corners, apex, &o);
  double aside = 0.0;
  for (uint i = 0; i < o.count; ++i) aside = fmax(aside, fabs(wt_dot3(target->n, o.at[i]) - target->height));
  if (aside <= WT_ON_SURFACE_M) return 0;
  wt_hider hider;
  if (!wt_hidden_space(facet, view, apex, &o, &hider)) return 0;
  shadow->count = hider.count;
  for (uint k = hider.count; k-- > 0;) {  // sides first: most candidates that are not apart lie beside the target
    shadow->inside[k] = side_of(target, hider.n[k], hider.c[k]);
    if (wt_outside(shadow->inside + k, p)) return 0;
  }
  return 1;
}

// The lists that tell what may hide a target.
typedef struct {
  const global wt_facet* facets;
  const global double* corners;
  const global wt_exact_surface* surfaces;
  const global wt_aperture* aperture;
  const global wt_chunk* chunks;
  const global wt_beam_candidate* candidates;
  uint only_opaque;
} wt_world;

// Takes what the candidates from `next` on hide from a polygon. Returns 1 if it is seen as a whole; else it is hidden,
// or what is left of it waits among the pieces.
inline int seen_whole(const wt_world* world, const wt_view* view, double3 apex, const wt_target* target,
                      const wt_polygon* p, uint next, wt_pieces* pieces) {
  const uint surface = target->surface;
  while (next != WT_NONE) {
    const uint chunk = next / WT_CHUNK, end = chunk * WT_CHUNK + world->chunks[chunk].count;
    const uint after = world->chunks[chunk].next, first_after = after == WT_NONE ? WT_NONE : after * WT_CHUNK;
    for (uint i = next; i < end; ++i) {
      if (apart(world->candidates + i, &target->box)) continue;
      const global wt_facet* facet = world->facets + world->candidates[i].facet;
      if (facet->surface == surface ||
          !wt_may_hide(world->aperture, world->surfaces, facet->surface, world->only_opaque))
        continue;
      wt_shadow shadow;
      if (!shadow_of(facet, world->corners, view, apex, target, p, &shadow)) continue;
      const int covers = wt_covers(&shadow, p);
      if (covers == 1) return 0;
      if (covers == 0) continue;
      wt_order_lines(&shadow, p);
      if (wt_split(&shadow, p, i + 1 < end ? i + 1 : first_after, pieces)) return 0;
    }
    next = first_after;
  }
  return 1;
}

// The part of the next mirror that a piece lights.
inline void store_aperture(global wt_aperture* next, uint node, uint surface, double3 apex, const wt_target* target,
                           const wt_polygon* p) {
  vstore3(apex + target->n * (2.0 * target->height), 0, next->image);
  next->node = node;
  next->surface = surface;
  next->own = WT_NONE;
  for (uint k = 0; k < p->count; ++k) vstore3(point_of(target, p->u[k], p->v[k]) + apex, k, next->corners);
  next->count = p->count;
}

// Adds to a sum of two words; the order of such additions does not change it.
inline void add_left_out(global wt_beam_counters* counters, ulong units) {
  const uint low = (uint)units, before = atomic_add(counters->left_out, low);
  atomic_add(counters->left_out + 1, (uint)(units >> 32) + (before + low < before));
}

kernel void beam_visible(const global wt_facet* facets, const global double* corners,
                         const global wt_exact_surface* surfaces, const global wt_aperture* apertures,
                         const global wt_chunk* chunks, const global wt_beam_candidate* candidates, global ulong* table,
                         global uint* quarters, global wt_aperture* next, global wt_beam_counters* counters,
                         wt_beam_arguments args) {
  const uint self = get_global_id(0), chunk = self / WT_CHUNK;
  if (chunk >= args.count || self % WT_CHUNK >= chunks[chunk].count || !candidates[self].may_reflect) return;
  const global wt_aperture* aperture = apertures + chunks[chunk].aperture;
  const double3 apex = wt_vector(aperture->image);
  wt_view view;
  wt_view_through(aperture, surfaces, apex, &view);
  const global wt_facet* facet = facets + candidates[self].facet;
  const global wt_exact_surface* s = surfaces + facet->surface;
  wt_target target;
  target.height = wt_plane_height(s, apex);
  target.n = wt_vector(s->normal) * (target.height < 0.0 ? -1.0 : 1.0);
  target.height = fabs(target.height);
  wt_axes_across(target.n, &target.u, &target.v);
  target.surface = facet->surface;
  wt_pieces pieces;
  pieces.height = target.height;
  pieces.kept_whole = 0;
  pieces.left_out = 0;
  {
    wt_outline o;
    wt_load_outline(facet, corners, apex, &o);
    lit_part(aperture, &view, apex, &o, &target, pieces.piece);
    const double sr = wt_solid_angle_bound(pieces.piece, target.height);
    pieces.count = sr > WT_LEAST_SR;
    if (!(sr > WT_LEAST_SR)) pieces.left_out = wt_in_sr_units(sr);
    pieces.next[0] = chunks[chunk].first * WT_CHUNK;
  }
  const wt_world world = {facets, corners, surfaces, aperture, chunks, candidates, args.only_opaque};
  uint node = WT_NONE;
  while (pieces.count > 0) {
    wt_polygon p;
    wt_copy_polygon(pieces.piece + --pieces.count, &p);
    set_box(&view, &target, &p);
    if (!seen_whole(&world, &view, apex, &target, &p, pieces.next[pieces.count], &pieces)) continue;
    if (node == WT_NONE) {
      node = wt_trie_insert(table, args.trie_mask, aperture->node, facet->surface);
      if (node == WT_NONE) {
        counters->trie_overflow = 1;
        return;
      }
      wt_note_quarters(quarters, node, WT_ALL_QUARTERS);
    }
    if (args.last) break;
    const uint slot = atomic_inc(&counters->apertures);
    if (slot < args.capacity) store_aperture(next + slot, node, facet->surface, apex, &target, &p);
  }
  if (pieces.kept_whole > 0) atomic_add(&counters->kept_whole, pieces.kept_whole);
  if (pieces.left_out > 0) add_left_out(counters, pieces.left_out);
}
