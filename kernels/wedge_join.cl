// SPDX-License-Identifier: Apache-2.0
// wedge_join: candidates of paths over one wedge, from prefixes of both ends that see it.
// A pair is rejected in float32 where the point of diffraction surely lies beyond the edge's ends, or a reflection
// beside its surface. It is conservative: the margin covers the rounding of what it is computed from.
#include "lib/join.clh"
#include "lib/wedge.clh"
#include "wavetracer/device/arguments.h"

inline float margin_of(float size) { return 1e-6f * size + 1e-3f; }

// May the leg between a prefix and a point of the edge leave its last surface?
inline int may_reach(const global wt_wedge_prefix* a, const global wt_surface* surfaces, float3 p) {
  return a->depth == 0 || wt_may_pass(surfaces + a->last, (float3)(a->image[0], a->image[1], a->image[2]), p);
}

// `lanes` work-items take each prefix of a block, in order of their wedges, with all prefixes that see the same wedge.
// The path crosses the edge where the unfolded one does: between both images' feet on its line, divided as their
// distances from it (Keller's cone).
kernel void wedge_join(const global uint* keys, const global wt_wedge_prefix* prefixes,
                       const global uint* receiver_of_origin, const global ushort* links, const global wt_wedge* wedges,
                       const global wt_surface* surfaces, global wt_wedge_candidate* out, global wt_counters* counters,
                       wt_wedge_join_arguments args) {
  const uint i = args.first + get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  if (i >= args.end || keys[i] == WT_NONE) return;
  const global wt_wedge_prefix* a = prefixes + i;
  if (a->origin >= args.transmitter_count || a->depth >= args.max_depth) return;
  const uint wedge = wt_wedge_of(keys[i]), last = wt_wedge_key(wedge, args.max_depth - 1 - a->depth);
  const uint first = wt_lower_bound_before(keys, i, wt_wedge_key(wedge, 0));
  wt_found_candidates batch;
  batch.count = 0;
  for (uint j = first + lane; j < args.count && keys[j] <= last; j += args.lanes) {
    const global wt_wedge_prefix* b = prefixes + j;
    const uint receiver = wt_wanted_receiver(a, b, 1, args.max_depth, receiver_of_origin, links, args.groups);
    if (receiver == WT_NONE) continue;
    const float legs = a->away + b->away, x = (a->along * b->away + b->along * a->away) / legs;
    const float margin = margin_of(fabs(a->along) + fabs(b->along) + legs);
    if (legs > margin) {
      if (!(x >= -margin && x <= a->length + margin)) continue;
      const global wt_wedge* w = wedges + wedge;
      const float3 p = (float3)((float)(w->start[0] + x * w->along[0]), (float)(w->start[1] + x * w->along[1]),
                                (float)(w->start[2] + x * w->along[2]));
      if (!may_reach(a, surfaces, p) || !may_reach(b, surfaces, p)) continue;
    }
    wt_emit_candidate(a, b, wedge, WT_NONE, receiver, &batch, out, args.capacity, counters);
  }
  wt_list_candidates(&batch, out, args.capacity, counters);
}
