// SPDX-License-Identifier: Apache-2.0
// beam_gather: lists the facets that an image may see through an aperture, or that may hide others there, near ones
// first. Much of what nothing shows is left out already: what one of a few large facets hides as a whole. One aperture
// per work-item; it walks the tree of facets with the planes of the beam.
#include "lib/screens.clh"
#pragma OPENCL FP_CONTRACT OFF

// The list that a work-item writes.
typedef struct {
  uint aperture, first, last, count;
} wt_list;

inline void append(wt_list* list, global wt_chunk* chunks, global wt_beam_candidate* candidates,
                   global wt_beam_counters* counters, uint capacity, const wt_view_box* box, uint facet,
                   int may_reflect) {
  if (list->count == WT_CHUNK || list->first == WT_NONE) {
    const uint chunk = atomic_inc(&counters->chunks);
    if (list->first == WT_NONE)
      list->first = chunk;
    else if (list->last < capacity)
      chunks[list->last] = (wt_chunk){list->aperture, list->first, chunk, WT_CHUNK};
    list->last = chunk;
    list->count = 0;
  }
  if (list->last < capacity)
    candidates[(size_t)list->last * WT_CHUNK + list->count] = (wt_beam_candidate){
        box->low_u, box->high_u, box->low_v, box->high_v, box->nearest, box->farthest, facet, may_reflect};
  ++list->count;
}

// May a surface be the next mirror? The last one may not, nor the instance of the end at a root, nor a plane that the
// image lies on.
inline int may_reflect(const global wt_aperture* aperture, const global wt_exact_surface* surfaces, uint surface,
                       double3 apex) {
  if (surface == aperture->surface) return 0;
  const global wt_exact_surface* s = surfaces + surface;
  if (aperture->own != WT_NONE && s->instance == aperture->own) return 0;
  return fabs(wt_plane_height(s, apex)) > (aperture->surface == WT_NONE ? WT_ON_SURFACE_M : 1e-9);
}

// The beam through an aperture, and what lies in it so far.
typedef struct {
  const global wt_aperture* aperture;
  double3 apex;
  wt_view view;
  wt_cone cone;
  wt_planes planes;
  wt_view_box box;
  wt_screens screens;
  double reach;  // the distance of the farthest point of the world from the image
} wt_beam_walk;

inline void begin_walk(const global wt_aperture* aperture, const global wt_exact_surface* surfaces,
                       wt_beam_walk* walk) {
  walk->aperture = aperture;
  walk->apex = wt_vector(aperture->image);
  walk->reach = 0.0;
  wt_view_through(aperture, surfaces, walk->apex, &walk->view);
  wt_beam_through(aperture, &walk->view, walk->apex, &walk->cone, &walk->box);
  wt_set_planes(&walk->cone, &walk->planes);
  wt_no_screens(&walk->view, &walk->box, &walk->screens);
}

// Lists a facet if it may be seen or may hide others.
inline void visit(wt_beam_walk* walk, const global wt_facet* facets, uint f, const global double* corners,
                  const global wt_exact_surface* surfaces, wt_list* list, global wt_chunk* chunks,
                  global wt_beam_candidate* candidates, global wt_beam_counters* counters, wt_beam_arguments args) {
  const global wt_facet* facet = facets + f;
  wt_outline o;
  wt_load_outline(facet, corners, walk->apex, &o);
  wt_view_box box;
  if (wt_outline_outside(&walk->cone, &o) || !wt_box_of(&walk->view, &o, &walk->box, &box) ||
      wt_outline_hidden(&walk->screens, &o))
    return;
  const int reflects = may_reflect(walk->aperture, surfaces, facet->surface, walk->apex);
  wt_hider hider;
  const int hides = wt_may_hide(walk->aperture, surfaces, facet->surface, args.only_opaque) &&
                    wt_hidden_space(facet, &walk->view, walk->apex, &o, &hider);
  if (reflects || hides) append(list, chunks, candidates, counters, args.capacity, &box, f, reflects);
  wt_screen screen;
  if (hides && wt_screen_of(&hider, &walk->screens.lit, &o, walk->reach, &box, &screen))
    wt_keep_screen(&screen, &walk->screens);
}

// Puts the children of a node that the beam meets on the stack, the nearer one on top. Returns the new height.
inline int visit_children(wt_beam_walk* walk, const global wt_bvh2_node* nodes, int node, int* stack, int top) {
  double3 centre[2], half_size[2];
  int meets[2];
  for (uint side = 0; side < 2; ++side) {
    wt_child_box(nodes + node, side, walk->apex, centre + side, half_size + side);
    if (node == 0) walk->reach = fmax(walk->reach, wt_length3(centre[side]) + wt_length3(half_size[side]));
    const float3 c = convert_float3(centre[side]), h = convert_float3(half_size[side]);
    meets[side] = !wt_box_outside(&walk->planes, c, h) && !wt_box_hidden(&walk->screens, c, h);
  }
  const uint far = wt_dot3(walk->view.n, centre[0]) < wt_dot3(walk->view.n, centre[1]);
  if (meets[far]) stack[top++] = nodes[node].child[far];
  if (meets[!far]) stack[top++] = nodes[node].child[!far];
  return top;
}

kernel void beam_gather(const global wt_bvh2_node* nodes, const global wt_facet* facets, const global double* corners,
                        const global wt_exact_surface* surfaces, const global wt_aperture* apertures,
                        global wt_chunk* chunks, global wt_beam_candidate* candidates,
                        global wt_beam_counters* counters, wt_beam_arguments args) {
  if (get_global_id(0) >= args.count) return;
  const uint i = args.first + get_global_id(0);
  wt_beam_walk walk;
  begin_walk(apertures + i, surfaces, &walk);
  wt_list list = {i, WT_NONE, WT_NONE, 0};
  int stack[WT_BEAM_STACK];
  stack[0] = 0;
  for (int top = 1; top > 0;) {
    const int node = stack[--top];
    if (node >= 0)
      top = visit_children(&walk, nodes, node, stack, top);
    else
      for (uint f = wt_leaf_first(node); f < wt_leaf_end(node); ++f)
        visit(&walk, facets, f, corners, surfaces, &list, chunks, candidates, counters, args);
  }
  if (list.last < args.capacity) chunks[list.last] = (wt_chunk){i, list.first, WT_NONE, list.count};
}
