// SPDX-License-Identifier: Apache-2.0
// The free ends of the edge of a path with one diffraction (edge_ends.h), from the path's legs. Vertices must be those
// of the exact solve: over an end, at the place that wt_place_of_end says.
#ifndef WAVETRACER_DEVICE_PATH_ENDS_H
#define WAVETRACER_DEVICE_PATH_ENDS_H
#include "wavetracer/device/path_chain.h"

// A device need not compile this for a scene without free ends.
#ifndef WT_EDGE_ENDS
#define WT_EDGE_ENDS 1
#endif

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// Places on an edge differ by less than this by rounding.
#define WT_AT_END_M 1e-6

// The ends of the only edge of a path. A path over an end has no point of stationary phase; the edge takes the
// directions and lengths of the shortest way over its line, as its wave has them. Reflections are unfolded.
inline wt_edge_ends wt_ends_at(const wt_field_world* world, const wt_path* path, wt_edge* edge) {
  const WT_GLOBAL wt_wedge* wedge = world->wedges + edge->number;
  if (wedge->free_ends == 0u) return wt_without_ends();
  const wt_double3 along = edge->frame.along, side_in = wt_cross3(edge->k_in, along);
  const wt_double3 side_out = wt_cross3(edge->k_out, along);
  const double at = wt_dot3(wt_vertex(path, edge->at) - wt_vector(wedge->start), along);
  wt_way_over way;
  way.from = at - edge->before_m * wt_dot3(edge->k_in, along);
  way.to = at + edge->after_m * wt_dot3(edge->k_out, along);
  way.from_m = edge->before_m * wt_length3(side_in);
  way.to_m = edge->after_m * wt_length3(side_out);
  if (!(way.from_m > 0.0 && way.to_m > 0.0)) return wt_without_ends();
  int over_end = 0;
  for (int i = 0; i < 2; ++i)
    over_end |= wt_ends_freely(wedge, i) && fabs(at - wt_place_of_end(wedge, i)) <= WT_AT_END_M;
  const wt_edge_ends ends = wt_ends_on(wedge, &way, edge->before_m + edge->after_m, over_end, world->wavelength_m);
  if (!over_end) return ends;
  const double shortest = wt_shortest_at(&way);
  const wt_double3 before = edge->k_in * edge->before_m + along * (shortest - at);
  const wt_double3 after = edge->k_out * edge->after_m - along * (shortest - at);
  edge->before_m = wt_length3(before);
  edge->after_m = wt_length3(after);
  edge->k_in = before / edge->before_m;
  edge->k_out = after / edge->after_m;
  return ends;
}

// The ends that count for a path over `count` edges: those of its only edge.
inline wt_edge_ends wt_ends_of(const wt_field_world* world, const wt_path* path, wt_edge* edges, wt_uint count) {
#if WT_EDGE_ENDS
  if (count == 1) return wt_ends_at(world, path, edges);
#endif
  return wt_without_ends();
}

// Does the path turn at all of its edges?
inline int wt_turns_at_all(const wt_edge* edges, wt_uint count) {
  int turns = 1;
  for (wt_uint i = 0; i < count; ++i) turns &= wt_turns(&edges[i].frame, edges[i].k_in, edges[i].k_out);
  return turns;
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
