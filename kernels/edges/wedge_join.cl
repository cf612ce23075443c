// SPDX-License-Identifier: Apache-2.0
// wedge_join: candidates of paths over one wedge, from prefixes of both ends that see it.
#include "lib/keller.clh"
#include "wavetracer/device/arguments.h"

// `lanes` work-items take each prefix of a block, in order of their wedges, with all prefixes that see the same wedge.
kernel void wedge_join(const global uint* keys, const global wt_wedge_prefix* prefixes,
                       const global uint* receiver_of_end, const global ushort* links, const global wt_wedge* wedges,
                       const global wt_surface* surfaces, global wt_wedge_candidate* out, global wt_counters* counters,
                       wt_wedge_join_arguments args) {
  const uint i = args.first + get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  if (i >= args.end || keys[i] == WT_NONE) return;
  const global wt_wedge_prefix* a = prefixes + i;
  if (a->end >= args.transmitter_count || a->depth >= args.max_depth) return;
  const uint wedge = wt_wedge_of(keys[i]), last = wt_wedge_key(wedge, args.max_depth - 1 - a->depth);
  const uint first = wt_lower_bound_before(keys, i, wt_wedge_key(wedge, 0));
  const wt_edge_onlooker from = wt_onlooker_of(a);
  wt_found_candidates batch;
  batch.count = 0;
  for (uint j = first + lane; j < args.count && keys[j] <= last; j += args.lanes) {
    const global wt_wedge_prefix* b = prefixes + j;
    const uint receiver = wt_wanted_receiver(a, b, 1, args.max_depth, receiver_of_end, links, args.groups);
    if (receiver == WT_NONE) continue;
    const wt_edge_onlooker to = wt_onlooker_of(b);
    if (wt_may_cross(&from, &to, wedges + wedge, surfaces, args.end_detour_m, 1, 1))
      wt_emit_candidate(a->node, b->node, wedge, WT_NONE, receiver, a->quarters & b->quarters, &batch, out,
                        args.capacity, counters);
  }
  wt_list_candidates(&batch, out, args.capacity, counters);
}
