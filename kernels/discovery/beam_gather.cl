// SPDX-License-Identifier: Apache-2.0
// beam_gather: lists the facets that an image may see through an aperture, or that may hide others there, near ones
// first. Much of what nothing shows is left out already: what one of a few large facets hides as a whole. A group of
// WT_LANES work-items takes one aperture; it walks the tree of facets with the planes of the beam.
#include "lib/beam_walk.clh"
#include "lib/outlook.clh"
#pragma OPENCL FP_CONTRACT OFF

// The list that a group writes.
typedef struct {
  uint aperture, first, last, count;
  uint fresh;  // the chunk that follows the last one, if the present facets need one
} wt_list;

// The facets that are looked at together.
typedef struct {
  wt_beam_candidate candidates[WT_BATCH];
  wt_screen screens[WT_BATCH];
  uint listed[WT_BATCH], is_screen[WT_BATCH];
  uint fresh[WT_BATCH], fresh_count;  // those that became screens
} wt_look;

// The world, and one aperture in it.
typedef struct {
  const global wt_facet* facets;
  const global double* corners;
  const global wt_exact_surface* surfaces;
  const global wt_aperture* aperture;
  const global wt_lit_space* lit;
  double3 apex;
  wt_view view;
  double reach;
  uint walls;  // that waves may have passed
  uint edges;  // not 0: edges diffract
} wt_scene_view;

// The use of a surface that may be seen. The last mirror has none, nor has the instance of the end at a root. If the
// image lies in the plane of the surface, only its edges may be seen.
inline uint use_of(const wt_scene_view* at, uint surface) {
  const global wt_aperture* aperture = at->aperture;
  if (surface == aperture->surface) return 0;
  const global wt_exact_surface* s = at->surfaces + surface;
  if (aperture->own != WT_NONE && s->instance == aperture->own) return 0;
  if (aperture->only_moving && s->instance == WT_NONE) return 0;
  if (fabs(wt_plane_height(s, at->apex)) > (aperture->surface == WT_NONE ? WT_ON_SURFACE_M : 1e-9)) return WT_MIRROR;
  return at->edges ? WT_EDGE_ON : 0;
}

// Looks at one facet: it is listed if it may be seen or may hide others.
inline void look_at(const wt_scene_view* at, uint f, const local wt_beam_walk* walk, local wt_look* look, uint k) {
  look->listed[k] = look->is_screen[k] = 0;
  const global wt_facet* facet = at->facets + f;
  wt_outline o;
  wt_load_outline(facet, at->corners, at->apex, &o);
  wt_view_box box;
  if (wt_outline_outside(at->lit, &o) || !wt_box_of(&at->view, &o, at->lit, &box) ||
      wt_outline_hidden(&walk->screens, &o))
    return;
  const uint use = use_of(at, facet->surface);
  wt_hider hider;
  const int hides = wt_may_hide(at->aperture, at->surfaces, facet->surface) &&
                    wt_hidden_space(facet, &at->view, at->apex, &o, &hider);
  if (!use && !hides) return;
  look->listed[k] = 1;
  look->candidates[k] =
      (wt_beam_candidate){box.low_u, box.high_u, box.low_v, box.high_v, box.nearest, box.farthest, f, use};
  look->is_screen[k] = hides && wt_keeps_screen(&walk->screens, wt_screen_size(&box)) &&
                       wt_is_opaque(at->aperture, at->surfaces, facet->surface, at->walls) &&
                       wt_screen_of(&hider, &at->view, at->lit, &o, at->reach, &box, look->screens + k);
}

// Is a facet hidden by a new screen, one of the facets that are looked at together?
inline int hidden_by_others(const wt_scene_view* at, const local wt_look* look, uint k) {
  if (look->fresh_count == 0) return 0;
  wt_outline o;
  wt_load_outline(at->facets + look->candidates[k].facet, at->corners, at->apex, &o);
  for (uint j = 0; j < look->fresh_count; ++j)
    if (look->fresh[j] != k && wt_outline_behind(look->screens + look->fresh[j], &o)) return 1;
  return 0;
}

// Makes room for `more` candidates: sets list->fresh if they do not all fit into the last chunk.
inline void make_room(local wt_list* list, uint more, global wt_chunk* chunks, global wt_beam_counters* counters,
                      uint capacity) {
  if (list->count + more <= WT_CHUNK) return;
  list->fresh = atomic_inc(&counters->chunks);
  if (list->first == WT_NONE)
    list->first = list->fresh;
  else if (list->last < capacity)
    chunks[list->last] = (wt_chunk){list->aperture, list->first, list->fresh, WT_CHUNK};
}

// Looks at the first `count` facets that wait, lists them in their order, and keeps the largest as screens.
inline void look_at_facets(const wt_scene_view* at, uint count, local wt_beam_walk* walk, local wt_look* look,
                           local wt_list* list, global wt_chunk* chunks, global wt_beam_candidate* candidates,
                           global wt_beam_counters* counters, uint capacity) {
  const uint lane = wt_lane();
  for (uint k = 0; k < count && WT_LANES == 1; ++k) wt_prefetch(at->facets + wt_leaf_first(walk->reached[k]));
  for (uint k = 0; k < count && WT_LANES == 1; ++k)
    wt_prefetch(at->corners + 3 * (size_t)at->facets[wt_leaf_first(walk->reached[k])].first_corner);
  for (uint k = lane; k < count; k += WT_LANES) look_at(at, wt_leaf_first(walk->reached[k]), walk, look, k);
  WT_SYNC();
  if (lane == 0) {
    uint fresh = 0;
    for (uint k = 0; k < count; ++k)
      if (look->is_screen[k] && wt_keep_screen(look->screens + k, &walk->screens)) look->fresh[fresh++] = k;
    look->fresh_count = fresh;
  }
  WT_SYNC();
  for (uint k = lane; k < count; k += WT_LANES)
    if (look->listed[k]) look->listed[k] = !hidden_by_others(at, look, k);
  WT_SYNC();
  uint more = 0;
  for (uint k = 0; k < count; ++k) more += look->listed[k];
  if (lane == 0) make_room(list, more, chunks, counters, capacity);
  WT_SYNC();
  uint slot = list->count;
  for (uint k = lane; k < count; k += WT_LANES) {
    for (uint j = k < WT_LANES ? 0 : k - WT_LANES; j < k; ++j) slot += look->listed[j];
    const uint chunk = slot < WT_CHUNK ? list->last : list->fresh;
    if (look->listed[k] && chunk < capacity)
      candidates[(size_t)chunk * WT_CHUNK + slot % WT_CHUNK] = look->candidates[k];
  }
  // Fewer than WT_BATCH facets wait after these, so those that move down meet no others.
  for (uint k = count + lane; k < walk->waiting; k += WT_LANES) walk->reached[k - count] = walk->reached[k];
  WT_SYNC();
  if (lane == 0) {
    walk->waiting -= count;
    list->count += more;
    if (list->count > WT_CHUNK) {
      list->last = list->fresh;
      list->count -= WT_CHUNK;
    }
  }
  WT_SYNC();
}

kernel void beam_gather(const global wt_bvh2_node* nodes, const global wt_facet* facets, const global double* corners,
                        const global wt_exact_surface* surfaces, const global wt_aperture* apertures,
                        global wt_lit_space* lit_spaces, global wt_outlook* outlooks, global wt_chunk* chunks,
                        global wt_beam_candidate* candidates, global wt_beam_counters* counters,
                        wt_beam_arguments args) {
  local wt_beam_walk walk;
  local wt_look look;
  local wt_list list;
  const uint i = args.first + get_group_id(0), lane = wt_lane();
  global wt_lit_space* lit = lit_spaces + get_group_id(0);
  if (lane == 0) {
    wt_set_lit_space(apertures + i, surfaces, lit);
    wt_begin_walk(lit, (int)args.root, &walk);
    list.aperture = i;
    list.first = list.last = WT_NONE;
    list.count = WT_CHUNK;  // the first candidate needs a chunk
    if (apertures[i].passed > args.walls) walk.top = 0;
  }
  WT_SYNC();
  wt_scene_view at = {.facets = facets,
                      .corners = corners,
                      .surfaces = surfaces,
                      .aperture = apertures + i,
                      .lit = lit,
                      .apex = wt_vector(apertures[i].image),
                      .walls = args.walls,
                      .edges = args.edges};
  wt_load_view(lit, &at.view);
  at.reach = wt_reach_of(nodes + args.root, at.apex);
  while (walk.top > 0 || walk.waiting > 0) {
    if (walk.waiting >= WT_BATCH || walk.top == 0)
      look_at_facets(&at, min(walk.waiting, WT_BATCH), &walk, &look, &list, chunks, candidates, counters,
                     args.capacity);
    else
      wt_descend(nodes, at.apex, at.view.n, &walk);
  }
  if (args.outlooks) wt_store_outlook(&walk.planes, &walk.screens, at.reach, outlooks + i);
  if (lane == 0 && list.last < args.capacity) chunks[list.last] = (wt_chunk){i, list.first, WT_NONE, list.count};
}
