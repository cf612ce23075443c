// SPDX-License-Identifier: Apache-2.0
// heard_join: candidates of paths over one wedge, from what listeners have heard (hear) and the prefixes of
// transmitters that see the wedge. A receiver tries all that its listener has heard. Its own prefixes are not listed:
// there are too many of them, and each is used once.
#include "lib/keller.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// Joins a receiver with the transmitters' prefixes from place `first` on, if their keys are at most `last`.
inline void join_receiver(const wt_edge_onlooker* to, uint node, uint wedge, uint receiver, uint found_by, uint first,
                          uint last, const global uint* keys, const global wt_wedge_prefix* prefixes,
                          const global ushort* links, const global wt_wedge* wedges, const global wt_surface* surfaces,
                          wt_found_candidates* batch, global wt_wedge_candidate* out, global wt_counters* counters,
                          wt_wedge_join_arguments args) {
  for (uint j = first; j < args.count && keys[j] <= last; ++j) {
    const global wt_wedge_prefix* a = prefixes + j;
    if (!(links[(size_t)a->end * args.groups + receiver / 16] >> receiver % 16 & 1)) continue;
    const wt_edge_onlooker from = wt_onlooker_of(a);
    if (wt_may_cross(&from, to, wedges + wedge, surfaces, args.end_detour_m, a->pieces, args.pieces))
      wt_emit_candidate(a->node, node, wedge, WT_NONE, receiver, a->quarters & found_by, batch, out, args.capacity,
                        counters);
  }
}

// `lanes` work-items take each node of a block of the trie and share the receivers of its listener. keys, prefixes: the
// args.count prefixes of transmitters, sorted.
kernel void heard_join(const global ulong* table, const global uint* quarters, const global uint* nodes,
                       const global double4* ends, const global uint* first_ends, const global wt_exact_surface* exact,
                       const global wt_surface* surfaces, const global wt_wedge* wedges, const global uint* keys,
                       const global wt_wedge_prefix* prefixes, const global uint* receiver_of_end,
                       const global ushort* links, global wt_wedge_candidate* out, global wt_counters* counters,
                       wt_wedge_join_arguments args) {
  const uint i = args.first + get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  if (i >= args.end || (nodes[i] & WT_ROOT)) return;
  wt_chains_prefetch(table, nodes, i, args.end);
  uint chain[WT_MAX_DEPTH], root;
  const uint depth = wt_chain(table, nodes[i], chain, &root) - 1;
  if (!(chain[depth] & WT_HEARD_WEDGE) || depth >= args.max_depth || first_ends[root] == first_ends[root + 1]) return;
  const uint wedge = chain[depth] & ~WT_HEARD_WEDGE, node = wt_trie_parent(table[nodes[i]]);
  const uint first = wt_lower_bound(keys, args.count, wt_wedge_key(wedge, 0));
  const uint last = wt_wedge_key(wedge, args.max_depth - 1 - depth);
  if (first >= args.count || keys[first] > last) return;
  const global wt_wedge* w = wedges + wedge;
  wt_found_candidates batch;
  batch.count = 0;
  for (uint end = first_ends[root] + lane; end < first_ends[root + 1]; end += args.lanes) {
    const uint receiver = receiver_of_end[end];
    double3 image = ends[end].xyz;
    for (uint k = 0; k < depth; ++k) image = wt_reflected(exact + chain[k], image);
    const double3 at = wt_in_wedge(w, image);
    if (receiver == WT_NONE || !wt_shows_wedge(w, surfaces, depth, depth > 0 ? chain[depth - 1] : WT_NONE, image, at))
      continue;
    const wt_edge_onlooker to = {convert_float3(image), (float)at.x, (float)wt_from_edge(at), depth,
                                 depth > 0 ? chain[depth - 1] : WT_NONE};
    join_receiver(&to, node, wedge, receiver, wt_found_by(quarters, nodes[i]), first, last, keys, prefixes, links,
                  wedges, surfaces, &batch, out, counters, args);
  }
  wt_list_candidates(&batch, out, args.capacity, counters);
}
