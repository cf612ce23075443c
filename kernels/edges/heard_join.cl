// SPDX-License-Identifier: Apache-2.0
// heard_join: candidates of paths over one wedge, from what listeners have heard (hear) and the prefixes of
// transmitters that see the wedge. A receiver tries all that its listener has heard. Its own prefixes are not listed:
// there are too many of them, and each is used once.
#include "lib/keller.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// Receivers that a work-item joins together: many on CPUs, where one work-item takes a node.
#ifdef WT_CPU
#define TOGETHER 64u
#else
#define TOGETHER 1u
#endif
#define MANY 7u  // WT_LEG_PACKET_MIN

// A node of a listener's trie: what it has met on the way to an edge.
typedef struct {
  uint node, wedge, found_by;  // without the edge, which comes last
  uint first, last;            // the place of the first prefix that sees the edge, and the last key of those
} heard_edge;

// Receivers that try a node, as they are seen from its edge.
typedef struct {
  wt_edge_onlooker seen[TOGETHER];
  uint receiver[TOGETHER];
  uint count;
} heard_receivers;

// Lists a candidate, if its path may cross the edge. from: what the transmitter's prefix `a` sees.
inline void join_pair(const heard_edge* heard, const global wt_wedge_prefix* a, const wt_edge_onlooker* from,
                      const wt_edge_onlooker* to, uint receiver, const global ushort* links,
                      const global wt_wedge* wedges, const global wt_surface* surfaces, wt_found_candidates* batch,
                      global wt_wedge_candidate* out, global wt_counters* counters, wt_wedge_join_arguments args) {
  if (!(links[(size_t)a->end * args.groups + receiver / 16] >> receiver % 16 & 1)) return;
  if (wt_may_cross(from, to, wedges + heard->wedge, surfaces, args.end_detour_m, a->pieces, args.pieces))
    wt_emit_candidate(a->node, heard->node, heard->wedge, WT_NONE, receiver, a->quarters & heard->found_by, batch, out,
                      args.capacity, counters);
}

// Joins receivers with the transmitters' prefixes. Many receivers follow each other in the list for each prefix,
// because their paths are near each other then (lib/leg_packet.clh).
inline void join_receivers(const heard_edge* heard, heard_receivers* to, const global uint* keys,
                           const global wt_wedge_prefix* prefixes, const global ushort* links,
                           const global wt_wedge* wedges, const global wt_surface* surfaces, wt_found_candidates* batch,
                           global wt_wedge_candidate* out, global wt_counters* counters, wt_wedge_join_arguments args) {
  const int many = to->count >= MANY;
  for (uint k = 0; !many && k < to->count; ++k) {
    const wt_edge_onlooker seen = to->seen[k];
    for (uint j = heard->first; j < args.count && keys[j] <= heard->last; ++j) {
      const wt_edge_onlooker from = wt_onlooker_of(prefixes + j);
      join_pair(heard, prefixes + j, &from, &seen, to->receiver[k], links, wedges, surfaces, batch, out, counters,
                args);
    }
  }
  for (uint j = heard->first; many && j < args.count && keys[j] <= heard->last; ++j) {
    const wt_edge_onlooker from = wt_onlooker_of(prefixes + j);
    for (uint k = 0; k < to->count; ++k)
      join_pair(heard, prefixes + j, &from, to->seen + k, to->receiver[k], links, wedges, surfaces, batch, out,
                counters, args);
  }
  to->count = 0;
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
  const uint wedge = chain[depth] & ~WT_HEARD_WEDGE;
  const heard_edge heard = {wt_trie_parent(table[nodes[i]]), wedge, wt_found_by(quarters, nodes[i]),
                            wt_lower_bound(keys, args.count, wt_wedge_key(wedge, 0)),
                            wt_wedge_key(wedge, args.max_depth - 1 - depth)};
  if (heard.first >= args.count || keys[heard.first] > heard.last) return;
  const global wt_wedge* w = wedges + wedge;
  const uint mirror = depth > 0 ? chain[depth - 1] : WT_NONE;
  wt_found_candidates batch;
  heard_receivers to;
  batch.count = to.count = 0;
  for (uint end = first_ends[root] + lane; end < first_ends[root + 1]; end += args.lanes) {
    const uint receiver = receiver_of_end[end];
    double3 image = ends[end].xyz;
    for (uint k = 0; k < depth; ++k) image = wt_reflected(exact + chain[k], image);
    const double3 at = wt_in_wedge(w, image);
    if (receiver == WT_NONE || !wt_shows_wedge(w, surfaces, depth, mirror, image, at)) continue;
    to.seen[to.count] = (wt_edge_onlooker){convert_float3(image), (float)at.x, (float)wt_from_edge(at), depth, mirror};
    to.receiver[to.count++] = receiver;
    if (to.count == TOGETHER)
      join_receivers(&heard, &to, keys, prefixes, links, wedges, surfaces, &batch, out, counters, args);
  }
  join_receivers(&heard, &to, keys, prefixes, links, wedges, surfaces, &batch, out, counters, args);
  wt_list_candidates(&batch, out, args.capacity, counters);
}
