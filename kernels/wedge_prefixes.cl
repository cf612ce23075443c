// wedge_prefixes: every wedge that some prefix sees. A node of the trie is a prefix and the surface that its rays met
// next, so it sees the wedges of that surface; a wedge between two such surfaces is listed once. Images are exact, and
// whether a prefix lies in the free sector of a wedge is decided here. Of what its last mirror surely does not show
// (float32, conservative) nothing is listed.
#include "lib/count.clh"
#include "lib/join.clh"
#include "lib/wedge.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// Quarters whose rays see the wedge from here on its other face.
inline uint by_other_face(const global ulong* table, uint mask, const global uint* quarters, uint node, uint seen,
                          const global wt_wedge* w) {
  const uint other = w->surfaces[w->surfaces[0] == seen];
  const uint beside = other == seen ? WT_NONE : wt_trie_find(table, mask, node, other);
  return beside == WT_NONE ? 0u : wt_found_by(quarters, beside);
}

// One node per work-item. surface_wedges[first_wedges[s] .. first_wedges[s + 1]] are the wedges of surface s. For each
// entry wt_wedge_key is what to sort by, and its prefix is listed.
kernel void wedge_prefixes(const global ulong* table, const global uint* quarters, const global uint* nodes,
                           const global double4* origins, const global wt_exact_surface* surfaces,
                           const global wt_surface* boxes, const global uint* first_wedges,
                           const global uint* surface_wedges, const global wt_wedge* wedges, global uint* keys,
                           global wt_wedge_prefix* prefixes, global wt_counters* counters,
                           wt_wedge_prefixes_arguments args) {
  const uint i = get_global_id(0);
  if (i >= wt_node_count(counters, args.node_count) || (nodes[i] & WT_ROOT)) return;
  uint chain[WT_MAX_DEPTH], origin;
  const uint depth = wt_chain(table, nodes[i], chain, &origin) - 1, seen = chain[depth];
  const uint node = wt_trie_parent(table[nodes[i]]);
  double3 image = origins[origin].xyz;
  for (uint k = 0; k < depth; ++k) image = wt_reflected(surfaces + chain[k], image);
  const uint found = wt_found_by(quarters, nodes[i]);
  // The vehicle that carries an antenna hides nothing from it, nor does it diffract.
  const uint own = depth == 0 ? wt_end_instance(origins[origin]) : WT_NONE;
  for (uint k = first_wedges[seen]; k < first_wedges[seen + 1]; ++k) {
    const uint number = surface_wedges[k];
    const global wt_wedge* w = wedges + number;
    if (own != WT_NONE && w->instance == own) continue;
    const double3 q = wt_in_wedge(w, image);
    if (!(w->length > 0.0) || !wt_in_sector(w, q)) continue;
    if (depth > 0 && !wt_may_show(boxes + chain[depth - 1], convert_float3(image), convert_float3(wt_on_edge(w, 0.0)),
                                  convert_float3(wt_on_edge(w, w->length))))
      continue;
    if (w->surfaces[0] != seen && wt_trie_find(table, args.trie_mask, node, w->surfaces[0]) != WT_NONE) continue;
    const uint slot = atomic_inc(&counters->wedge_prefixes);
    if (slot >= args.capacity) continue;
    keys[slot] = wt_wedge_key(number, depth);
    prefixes[slot].quarters =
        found == WT_ALL_QUARTERS ? found : found | by_other_face(table, args.trie_mask, quarters, node, seen, w);
    prefixes[slot].pieces = (1u << WT_WEDGE_PIECES) - 1u;
    prefixes[slot].node = node;
    prefixes[slot].origin = origin;
    prefixes[slot].depth = depth;
    prefixes[slot].last = depth > 0 ? chain[depth - 1] : WT_NONE;
    prefixes[slot].image[0] = (float)image.x;
    prefixes[slot].image[1] = (float)image.y;
    prefixes[slot].image[2] = (float)image.z;
    prefixes[slot].along = (float)q.x;
    prefixes[slot].away = (float)wt_from_edge(q);
    prefixes[slot].length = (float)w->length;
  }
}
