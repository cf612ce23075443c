// SPDX-License-Identifier: Apache-2.0
// wedge_prefixes: lists every wedge that some prefix sees. A node of the trie is a prefix and the surface that its rays
// met next, so it sees the wedges of that surface; a wedge between two such surfaces is listed once. Images are exact,
// and this pass decides whether a prefix lies in the free sector of a wedge. A wedge that the last mirror surely does
// not show (float32, conservative) is not listed.
#include "lib/count.clh"
#include "lib/join.clh"
#include "lib/wedge.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// An onlooker of wedges: the node of a prefix and the surface that its rays met next.
typedef struct {
  uint node, seen, end, depth, last;
  uint quarters;
  double3 image;
} wt_onlooker;

// A wedge that the onlooker sees, with its image in the wedge's axes.
typedef struct {
  uint wedge;
  double3 at;
} wt_view;

// The number of views that are listed together, so that their look-ups in the trie wait for memory together.
#define WT_VIEWS WT_AHEAD

inline uint other_face(const global wt_wedge* w, uint seen) { return w->surfaces[w->surfaces[0] == seen]; }

// The quarters whose rays see the wedge from here on its other face.
inline uint by_other_face(const global ulong* table, uint mask, const global uint* quarters, const wt_onlooker* from,
                          const global wt_wedge* w) {
  const uint other = other_face(w, from->seen);
  const uint beside = other == from->seen ? WT_NONE : wt_trie_find(table, mask, from->node, other);
  return beside == WT_NONE ? 0u : wt_found_by(quarters, beside);
}

// Lists that the onlooker sees a wedge. at: its image in the wedge's axes; seen_by: the quarters whose rays see it;
// slot: a place of the list.
inline void list_view(uint wedge, double3 at, const wt_onlooker* from, uint seen_by, const global wt_wedge* wedges,
                      uint slot, global uint* keys, global wt_wedge_prefix* prefixes,
                      wt_wedge_prefixes_arguments args) {
  if (slot >= args.capacity) return;
  keys[slot] = wt_wedge_key(wedge, from->depth);
  prefixes[slot].quarters = seen_by;
  prefixes[slot].pieces = 0xFFFFFFFFu;  // wedge_sight has not tested it
  prefixes[slot].first = -1.0f;
  prefixes[slot].final = (float)wedges[wedge].length + 1.0f;
  prefixes[slot].node = from->node;
  prefixes[slot].end = from->end;
  prefixes[slot].depth = from->depth;
  prefixes[slot].last = from->last;
  prefixes[slot].image[0] = (float)from->image.x;
  prefixes[slot].image[1] = (float)from->image.y;
  prefixes[slot].image[2] = (float)from->image.z;
  prefixes[slot].along = (float)at.x;
  prefixes[slot].away = (float)wt_from_edge(at);
  prefixes[slot].length = (float)wedges[wedge].length;
  prefixes[slot].azimuth = 0.0f;
  prefixes[slot].nearness = INFINITY;
}

// Lists the views, except those that the prefix also has through the wedge's first face, by another node.
inline void list_views(const global ulong* table, const global uint* quarters, const global wt_wedge* wedges,
                       const wt_onlooker* from, wt_view* views, uint count, global uint* keys,
                       global wt_wedge_prefix* prefixes, global wt_counters* counters,
                       wt_wedge_prefixes_arguments args) {
  uint kept = 0;
  for (uint k = 0; k < count; ++k) {
    const uint face = wedges[views[k].wedge].surfaces[0];
    if (face == from->seen || wt_trie_find(table, args.trie_mask, from->node, face) == WT_NONE)
      views[kept++] = views[k];
  }
  if (kept == 0) return;
  uint slot = wt_take_places(&counters->wedge_prefixes, kept);
  for (uint k = 0; k < kept && slot < args.capacity; ++k, ++slot) {
    const uint wedge = views[k].wedge;
    uint seen_by = from->quarters;
    if (seen_by != WT_ALL_QUARTERS) seen_by |= by_other_face(table, args.trie_mask, quarters, from, wedges + wedge);
    list_view(wedge, views[k].at, from, seen_by, wedges, slot, keys, prefixes, args);
  }
}

// Lists what an end sees by the chain of surfaces, the last of which its rays met next.
inline void look(uint end, uint node, const uint* chain, uint depth, const global ulong* table,
                 const global uint* quarters, const global double4* ends, const global wt_exact_surface* surfaces,
                 const global wt_surface* boxes, const global uint* first_wedges, const global uint* sides,
                 const global uint* surface_wedges, const global wt_wedge* wedges, global uint* keys,
                 global wt_wedge_prefix* prefixes, global wt_counters* counters, wt_wedge_prefixes_arguments args) {
  wt_onlooker from;
  from.end = end;
  from.depth = depth;
  from.seen = chain[depth];
  from.last = depth > 0 ? chain[depth - 1] : WT_NONE;
  from.node = wt_trie_parent(table[node]);
  from.quarters = wt_found_by(quarters, node);
  from.image = ends[end].xyz;
  for (uint k = 0; k < depth; ++k) from.image = wt_reflected(surfaces + chain[k], from.image);
  // The vehicle that carries an antenna hides nothing from it, and does not diffract its waves.
  const uint own = depth == 0 ? wt_end_instance(ends[end]) : WT_NONE;
  wt_view views[WT_VIEWS];
  uint count = 0;
  const uint2 range = wt_wedges_seen(surfaces, first_wedges, sides, from.seen, from.image);
  for (uint k = range.x; k < range.y; ++k) {
    const global wt_wedge* w = wedges + surface_wedges[k];
    if (own != WT_NONE && w->instance == own) continue;
    views[count].wedge = surface_wedges[k];
    views[count].at = wt_in_wedge(w, from.image);
    if (!wt_shows_wedge(w, boxes, from.depth, from.last, from.image, views[count].at)) continue;
    wt_trie_prefetch(table, quarters, args.trie_mask, from.node, other_face(w, from.seen));
    if (++count < WT_VIEWS) continue;
    list_views(table, quarters, wedges, &from, views, count, keys, prefixes, counters, args);
    count = 0;
  }
  if (count > 0) list_views(table, quarters, wedges, &from, views, count, keys, prefixes, counters, args);
}

// args.lanes work-items per node, which share the ends of its root (first_ends). surface_wedges[first_wedges[s] ..
// first_wedges[s + 1]] are the wedges of surface s. Those that the side against its normal does not see come from
// sides[2 s + 1] on, those that the other side does not see before sides[2 s]. Each entry is listed with its prefix and
// with wt_wedge_key, its sort key.
kernel void wedge_prefixes(const global ulong* table, const global uint* quarters, const global uint* nodes,
                           const global double4* ends, const global uint* first_ends,
                           const global wt_exact_surface* surfaces, const global wt_surface* boxes,
                           const global uint* first_wedges, const global uint* sides, const global uint* surface_wedges,
                           const global wt_wedge* wedges, global uint* keys, global wt_wedge_prefix* prefixes,
                           global wt_counters* counters, wt_wedge_prefixes_arguments args) {
  const uint i = get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  const uint node_count = wt_node_count(counters, args.node_count);
  if (i >= node_count || (nodes[i] & WT_ROOT)) return;
  wt_chains_prefetch(table, nodes, i, node_count);
  uint chain[WT_MAX_DEPTH], root;
  const uint depth = wt_chain(table, nodes[i], chain, &root) - 1;
  for (uint end = first_ends[root] + lane; end < first_ends[root + 1]; end += args.lanes)
    look(end, nodes[i], chain, depth, table, quarters, ends, surfaces, boxes, first_wedges, sides, surface_wedges,
         wedges, keys, prefixes, counters, args);
}

// One sorted key per work-item: its prefix goes to the place of the key. Prefixes that see nothing have the last keys,
// and nothing reads them.
kernel void place_prefixes(const global uint* keys, const global uint* order, const global wt_wedge_prefix* prefixes,
                           global wt_wedge_prefix* sorted, uint count) {
  const uint i = get_global_id(0);
  if (i < count && keys[i] != WT_NONE) sorted[i] = prefixes[order[i]];
}
