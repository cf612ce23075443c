// SPDX-License-Identifier: Apache-2.0
// The edges of a diffracted path: where they are, their lengths, and how the wave spreads from them.
// Spreading: edges are lines of sources, so stationary phase over the points on them gives 1 / (product of the legs
// between ends and edges) / sqrt(det H), where H has the second derivatives of the length. For one edge it is that of
// K-P (sqrt(s' / (s (s + s'))) / s'), and for more it is symmetric. It assumes up to WT_MOST_EDGES diffractions; no two
// that follow each other are at one wedge. A tile or a point of a target ends one wave and begins another: the edges on
// either side of it have the lengths of their side.
#ifndef WAVETRACER_DEVICE_EDGES_OF_PATH_H
#define WAVETRACER_DEVICE_EDGES_OF_PATH_H
#include "wavetracer/device/edge_turn.h"
#include "wavetracer/device/path_world.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// A device need not compile code for more diffractions of a path than there are.
#ifndef WT_DIFFRACTS
#define WT_DIFFRACTS 8
#endif

// The room for the edges of a path. One edge can stay in registers.
#define WT_EDGE_ROOM (WT_DIFFRACTS == 1 ? 1u : WT_MOST_EDGES)

// A diffraction of the path.
typedef struct {
  wt_uint at;  // the number of its vertex
  wt_uint number;
  wt_wedge_frame frame;
  wt_double3 k_in, k_out;
  double before_m, after_m;  // to the end or edge before and after it, reflections unfolded
  double path_m;             // the length of the whole path, or of its part on this side of a tile or target
} wt_edge;

inline double wt_sine2(const wt_edge* edge) {  // sin^2 of the angle between edge and path
  const double cosine = wt_dot3(edge->k_in, edge->frame.along);
  return (1.0 - cosine) * (1.0 + cosine);
}

#if WT_EDGES_BESIDE
// Sets the last lengths of the edges before a tile or target; after_m: the way from the last of them to it.
inline void wt_end_edges(wt_edge* edges, wt_uint count, double after_m) {
  double path_m = 0.0;
  if (count > 0) edges[count - 1].after_m = after_m;
  for (wt_uint i = 0; i < count; ++i) path_m += edges[i].before_m;
  for (wt_uint i = 0; i < count; ++i) edges[i].path_m = path_m + after_m;
}
#endif

// Finds the edges of the path, at most WT_EDGE_ROOM. Returns their number.
inline wt_uint wt_edges_of(const wt_field_world* world, const wt_path* path, wt_edge* edges) {
  wt_uint count = 0, first = 0;  // first: of those after a tile or target
  wt_walk_leg leg = wt_first_leg(path);
  double since_m = leg.length_m, path_m = 0.0;
  for (wt_uint k = 0; k < path->depth; ++k) {
    const wt_walk_leg next = wt_next_leg(world, path, k, &leg);
#if WT_EDGES_BESIDE
    if (wt_begins_wave(wt_step(path, k))) {
      wt_end_edges(edges + first, count - first, since_m);
      first = count;
      since_m = 0.0;
    }
#endif
    if (wt_kind(path, k) == WT_STEP_DIFFRACTION && count < WT_EDGE_ROOM) {
      if (count > first) edges[count - 1].after_m = since_m;
      const WT_GLOBAL wt_wedge* wedge = world->wedges + wt_number(path, k);
      wt_edge* edge = edges + count++;
      edge->at = k;
      edge->number = wt_number(path, k);
      edge->frame.along = wt_vector(wedge->along);
      edge->frame.face = wt_vector(wedge->face);
      edge->frame.normal = wt_vector(wedge->normal);
      edge->frame.exterior = wedge->exterior;
      edge->k_in = leg.direction;
      edge->k_out = next.direction;
      edge->before_m = since_m;
      edge->after_m = 0.0;
      since_m = 0.0;
    }
    since_m += next.length_m;
    leg = next;
  }
  if (count > first) edges[count - 1].after_m = since_m;
  for (wt_uint i = first; i < count; ++i) path_m += edges[i].before_m;
  for (wt_uint i = first; i < count; ++i) edges[i].path_m = path_m + since_m;
  return count;
}

// Is one of the edges of the path a corner, with less than a half space around it?
inline int wt_passes_corner(const wt_field_world* world, const wt_path* path) {
  for (wt_uint k = 0; k < path->depth; ++k)
    if (wt_kind(path, k) == WT_STEP_DIFFRACTION && world->wedges[wt_number(path, k)].exterior < WT_PI) return 1;
  return 0;
}

// Is the path outside of the theory, which holds for short waves? It holds if edges are about a wavelength long and
// about a wavelength away from the ends of their rays. At a tenth of this distance a screen raises the field behind it
// by 3 dB.
inline int wt_is_near_edge(const wt_field_world* world, const wt_edge* edges, wt_uint count) {
  double least_m = WT_INFINITY;
  for (wt_uint i = 0; i < count; ++i)
    least_m = fmin(fmin(least_m, world->wedges[edges[i].number].length), fmin(edges[i].before_m, edges[i].after_m));
  return least_m < world->wavelength_m;
}

// H has three diagonals, so its determinant is the product of the pivots of its rows. edges: the path turns at all of
// them, see wt_turns.
inline double wt_edge_spreading(const wt_edge* edges, wt_uint count) {
  double legs = edges->before_m, determinant = 1.0, before = 1.0;
  for (wt_uint i = 0; i < count; ++i) {
    const wt_edge* b = edges + i;
    const double yy = wt_sine2(b) * (1.0 / b->before_m + 1.0 / b->after_m);
    double both = yy * determinant;
    if (i > 0) {
      const wt_double3 v = b[-1].frame.along, w = b->frame.along, k = b[-1].k_out;
      const double xy = (wt_dot3(v, k) * wt_dot3(w, k) - wt_dot3(v, w)) / b->before_m;
      both -= xy * xy * before;
    }
    before = determinant;
    determinant = both;
    legs *= b->after_m;
  }
  return 1.0 / (legs * sqrt(determinant));
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
