// SPDX-License-Identifier: Apache-2.0
// target_edges: candidates of ways from an end over one edge to a point of a target, from the prefixes of all ends that
// see the edge. Points launch no rays, so the way goes straight from the edge to the point.
#include "lib/keller.clh"
#include "wavetracer/device/arguments.h"
#pragma OPENCL FP_CONTRACT OFF

// Does the point see the edge as far as its free sector goes? Its own vehicle has no edges for it, as it is no mirror.
inline int may_diffract_to(const global wt_target_point* point, const global wt_wedge* w, double3* at) {
  if (!point->present || (point->instance != WT_NONE && point->instance == w->instance)) return 0;
  *at = wt_in_wedge(w, (double3)(point->position[0], point->position[1], point->position[2]));
  return w->length > 0.0 && wt_in_sector(w, *at, 0.0);
}

// `lanes` work-items take each prefix of a block, in the order of their wedges, and share the args.count points. The
// receiver of a candidate is the number of its point. links: the ends that look for each point. args.max_depth: the
// most interactions of a way, its edge included.
kernel void target_edges(const global uint* keys, const global wt_wedge_prefix* prefixes,
                         const global wt_target_point* points, const global ushort* links,
                         const global wt_wedge* wedges, const global wt_surface* surfaces,
                         global wt_wedge_candidate* out, global wt_counters* counters, wt_wedge_join_arguments args) {
  const uint i = args.first + get_global_id(0) / args.lanes, lane = get_global_id(0) % args.lanes;
  if (i >= args.end || keys[i] == WT_NONE) return;
  const global wt_wedge_prefix* a = prefixes + i;
  const uint wedge = wt_wedge_of(keys[i]);
  const global wt_wedge* w = wedges + wedge;
  // A corner would need all of its reflections beside it.
  if (a->depth >= args.max_depth || w->exterior < M_PI) return;
  const wt_edge_onlooker from = wt_onlooker_of(a);
  wt_found_candidates batch;
  batch.count = 0;
  for (uint j = lane; j < args.count; j += args.lanes) {
    double3 at;
    if (!(links[(size_t)a->end * args.groups + j / 16] >> j % 16 & 1)) continue;
    if (!may_diffract_to(points + j, w, &at)) continue;
    const float3 p = (float3)((float)points[j].position[0], (float)points[j].position[1], (float)points[j].position[2]);
    const wt_edge_onlooker to = {p, (float)at.x, (float)wt_from_edge(at), 0, WT_NONE};
    if (wt_may_cross(&from, &to, w, surfaces, args.end_detour_m, 1, 1))
      wt_emit_candidate(a->node, WT_ROOT, wedge, WT_NONE, j, a->quarters, &batch, out, args.capacity, counters);
  }
  wt_list_candidates(&batch, out, args.capacity, counters);
}
