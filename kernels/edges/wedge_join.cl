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

// May there be a path over a free end of the edge, where the shortest way between two images leaves it at x?
inline int may_end(const global wt_wedge_prefix* a, const global wt_wedge_prefix* b, uint free_ends, float x,
                   float margin, float end_detour_m) {
  if (!(free_ends & (x < 0.0f ? WT_FREE_START : WT_FREE_END))) return 0;
  const float end = x < 0.0f ? 0.0f : a->length, legs = a->away + b->away, apart = b->along - a->along;
  const float from = end - a->along, to = b->along - end;
  const float over = sqrt(from * from + a->away * a->away) + sqrt(to * to + b->away * b->away);
  return over - sqrt(legs * legs + apart * apart) <= end_detour_m + 4.0f * margin;
}

// `lanes` work-items take each prefix of a block, in order of their wedges, with all prefixes that see the same wedge.
// The path crosses the edge where the unfolded one does: between both images' feet on its line, divided as their
// distances from it (Keller's cone).
kernel void wedge_join(const global uint* keys, const global wt_wedge_prefix* prefixes,
                       const global uint* receiver_of_end, const global ushort* links, const global wt_wedge* wedges,
                       const global wt_surface* surfaces, global wt_wedge_candidate* out, global wt_counters* counters,
                       wt_wedge_join_arguments args) {
  const uint i = args.first + get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  if (i >= args.end || keys[i] == WT_NONE) return;
  const global wt_wedge_prefix* a = prefixes + i;
  if (a->end >= args.transmitter_count || a->depth >= args.max_depth) return;
  const uint wedge = wt_wedge_of(keys[i]), last = wt_wedge_key(wedge, args.max_depth - 1 - a->depth);
  const uint free_ends = wedges[wedge].free_ends;
  const uint first = wt_lower_bound_before(keys, i, wt_wedge_key(wedge, 0));
  wt_found_candidates batch;
  batch.count = 0;
  for (uint j = first + lane; j < args.count && keys[j] <= last; j += args.lanes) {
    const global wt_wedge_prefix* b = prefixes + j;
    const uint receiver = wt_wanted_receiver(a, b, 1, args.max_depth, receiver_of_end, links, args.groups);
    if (receiver == WT_NONE) continue;
    const float legs = a->away + b->away, at = (a->along * b->away + b->along * a->away) / legs;
    const float margin = margin_of(fabs(a->along) + fabs(b->along) + legs);
    if (legs > margin) {
      if (!(at >= -margin && at <= a->length + margin) && !may_end(a, b, free_ends, at, margin, args.end_detour_m))
        continue;
      const float x = clamp(at, -margin, a->length + margin);
      const global wt_wedge* w = wedges + wedge;
      const float3 p = (float3)((float)(w->start[0] + x * w->along[0]), (float)(w->start[1] + x * w->along[1]),
                                (float)(w->start[2] + x * w->along[2]));
      if (!may_reach(a, surfaces, p) || !may_reach(b, surfaces, p)) continue;
    }
    wt_emit_candidate(a, b, wedge, WT_NONE, receiver, &batch, out, args.capacity, counters);
  }
  wt_list_candidates(&batch, out, args.capacity, counters);
}
