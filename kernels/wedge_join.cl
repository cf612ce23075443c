// wedge_join: candidates of diffracted paths, from prefixes of both ends that see the same wedge, or two wedges.
// Rejected in float32 where the point of diffraction surely lies beyond the edge's ends, or a reflection beside its
// surface. Conservative: the margin covers the rounding of what it is computed from.
#include "lib/join.clh"
#include "lib/wedge.clh"
#include "wavetracer/device/arguments.h"

inline float margin_of(float size) { return 1e-6f * size + 1e-3f; }

// Is a path wanted from the transmitter of a to the receiver of b, and short enough with so many diffractions? Its
// receiver, or WT_NONE.
inline uint wanted_receiver(const global wt_wedge_prefix* a, const global wt_wedge_prefix* b, uint diffractions,
                            uint max_depth, const global uint* receiver_of_origin, const global ushort* links,
                            uint groups) {
  if (a->depth + b->depth + diffractions > max_depth) return WT_NONE;
  const uint receiver = receiver_of_origin[b->origin];
  if (receiver == WT_NONE || !(links[(size_t)a->origin * groups + receiver / 16] >> receiver % 16 & 1)) return WT_NONE;
  return receiver;
}

inline void emit(const global wt_wedge_prefix* a, const global wt_wedge_prefix* b, uint wedge_a, uint wedge_b,
                 uint receiver, global wt_wedge_candidate* out, uint capacity, global wt_counters* counters) {
  const uint slot = atomic_inc(&counters->wedge_candidates);
  if (slot >= capacity) return;
  out[slot].node = a->node;
  out[slot].back = b->node;
  out[slot].wedges[0] = wedge_a;
  out[slot].wedges[1] = wedge_b;
  out[slot].receiver = receiver;
  out[slot].quarters = a->quarters & b->quarters;
}

// May the leg between a prefix and a point of the edge leave its last surface?
inline int may_reach(const global wt_wedge_prefix* a, const global wt_surface* surfaces, float3 p) {
  return a->depth == 0 || wt_may_pass(surfaces + a->last, (float3)(a->image[0], a->image[1], a->image[2]), p);
}

// `lanes` work-items a prefix, in order of their wedges, with all that see the same one. The path crosses the edge
// where the unfolded one does: between both images' feet on its line, divided as their distances from it (Keller's
// cone).
kernel void wedge_join(const global uint* keys, const global uint* order, const global wt_wedge_prefix* prefixes,
                       const global uint* receiver_of_origin, const global ushort* links, const global wt_wedge* wedges,
                       const global wt_surface* surfaces, global wt_wedge_candidate* out, global wt_counters* counters,
                       wt_wedge_join_arguments args) {
  const uint i = get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  if (i >= args.count) return;
  const global wt_wedge_prefix* a = prefixes + order[i];
  if (a->origin >= args.transmitter_count || a->depth >= args.max_depth) return;
  const uint wedge = wt_wedge_of(keys[i]), last = wt_wedge_key(wedge, args.max_depth - 1 - a->depth);
  const uint first = wt_lower_bound(keys, args.count, wt_wedge_key(wedge, 0));
  for (uint j = first + lane; j < args.count && keys[j] <= last; j += args.lanes) {
    const global wt_wedge_prefix* b = prefixes + order[j];
    const uint receiver = wanted_receiver(a, b, 1, args.max_depth, receiver_of_origin, links, args.groups);
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
    emit(a, b, wedge, WT_NONE, receiver, out, args.capacity, counters);
  }
}

// Paths over two wedges, straight from one to the other: every prefix of a transmitter with every one that sees another
// wedge, if some part of either lies in the free sector of the other.
inline int may_see(const global wt_wedge* w, const global wt_wedge* other) {
  return wt_in_sector(w, wt_in_wedge(w, wt_on_edge(other, 0.0))) ||
         wt_in_sector(w, wt_in_wedge(w, wt_on_edge(other, other->length)));
}

kernel void wedge_pairs(const global uint* keys, const global uint* order, const global wt_wedge_prefix* prefixes,
                        const global uint* receiver_of_origin, const global ushort* links,
                        const global wt_wedge* wedges, global wt_wedge_candidate* out, global wt_counters* counters,
                        wt_wedge_join_arguments args) {
  const uint i = get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  if (i >= args.count) return;
  const global wt_wedge_prefix* a = prefixes + order[i];
  if (a->origin >= args.transmitter_count || a->depth + 2 > args.max_depth) return;
  const uint wedge_a = wt_wedge_of(keys[i]);
  uint checked = WT_NONE;
  int seen = 0;
  for (uint j = lane; j < args.count; j += args.lanes) {
    const uint wedge_b = wt_wedge_of(keys[j]);
    if (wedge_b == wedge_a) continue;
    const global wt_wedge_prefix* b = prefixes + order[j];
    const uint receiver = wanted_receiver(a, b, 2, args.max_depth, receiver_of_origin, links, args.groups);
    if (receiver == WT_NONE) continue;
    if (wedge_b != checked) {
      checked = wedge_b;
      const global wt_wedge* v = wedges + wedge_a;
      const global wt_wedge* w = wedges + checked;
      seen = wt_share_face(v, w) || (may_see(v, w) && may_see(w, v));
    }
    if (seen) emit(a, b, wedge_a, wedge_b, receiver, out, args.capacity, counters);
  }
}
