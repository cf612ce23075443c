// SPDX-License-Identifier: Apache-2.0
// Paths along the plane of a roof or a wall that begin and end in it, beyond its edges: the wave over its edges is all
// of them. An end in the plane is taken for one that is just behind it, so paths without those edges are none there;
// what float32 says of them is luck. In front of the plane they are back, and their fields meet.
#ifndef WAVETRACER_DEVICE_PATH_ALONG_H
#define WAVETRACER_DEVICE_PATH_ALONG_H
#include "wavetracer/device/path_world.h"

#ifndef __OPENCL_VERSION__
namespace wavetracer::device {
#endif

// Paths along one plane whose ends are as far off it as WT_ON_SURFACE_M differ no more than this in length.
#define WT_ALONG_LENGTH_M (3.0 * WT_ON_SURFACE_M)

// Points from an edge of the wedge into face 0 or 1; its normal, into free space.
inline wt_double3 wt_face_way(const WT_GLOBAL wt_wedge* w, int face) {
  const wt_double3 along_face = wt_vector(w->face);
  return face == 0 ? along_face : along_face * w->cosine + wt_vector(w->normal) * w->sine;
}
inline wt_double3 wt_face_up(const WT_GLOBAL wt_wedge* w, int face) {
  const wt_double3 normal = wt_vector(w->normal);
  return face == 0 ? normal : wt_vector(w->face) * w->sine - normal * w->cosine;
}

// The stop before vertex k of the path: the vertex before it, or its transmitter. k is up to depth + 1, past its
// receiver.
inline wt_double3 wt_stop_before(const wt_path* path, wt_uint k) {
  return k == 0 ? path->from : k > path->depth ? path->to : wt_vertex(path, k - 1);
}

// Does a plane between edges k and k + 1 of the path, which bounds both, hold two points?
inline int wt_edges_bound(const wt_field_world* world, const wt_path* path, wt_uint k, wt_double3 a, wt_double3 b) {
  if (wt_kind(path, k) != WT_STEP_DIFFRACTION || wt_kind(path, k + 1) != WT_STEP_DIFFRACTION) return 0;
  const WT_GLOBAL wt_wedge *v = world->wedges + wt_number(path, k), *w = world->wedges + wt_number(path, k + 1);
  const wt_double3 p = wt_vertex(path, k), q = wt_vertex(path, k + 1);
  for (int i = 0; i < 4; ++i) {
    if (v->planes[i / 2] != w->planes[i % 2]) continue;
    const wt_double3 n = wt_face_up(v, i / 2);
    if (wt_dot3(wt_face_way(v, i / 2), q - p) > 0.0 && wt_dot3(wt_face_way(w, i % 2), p - q) > 0.0 &&
        fabs(wt_dot3(n, a - p)) <= WT_ON_SURFACE_M && fabs(wt_dot3(n, b - p)) <= WT_ON_SURFACE_M)
      return 1;
  }
  return 0;
}

// Is the path a part of a longer one of its link, which has edges besides between two of its stops, along whose plane
// both run? Lengths are equal to WT_ALONG_LENGTH_M.
inline int wt_is_part_of(const wt_field_world* world, const wt_path* path, const wt_path* longer) {
  const wt_uint more = longer->depth - path->depth;
  if (path->transmitter != longer->transmitter || path->receiver != longer->receiver) return 0;
  wt_uint same = 0;
  while (same < path->depth && wt_step(path, same) == wt_step(longer, same)) ++same;
  for (wt_uint k = same; k < path->depth; ++k)
    if (wt_step(path, k) != wt_step(longer, k + more)) return 0;
  for (wt_uint k = same; k < same + more; ++k)
    if (wt_kind(longer, k) != WT_STEP_DIFFRACTION) return 0;
  const wt_double3 a = wt_stop_before(longer, same), b = wt_stop_before(longer, same + more + 1u);
  for (wt_uint k = same > 0 ? same - 1u : 0u; k < same + more && k + 1u < longer->depth; ++k)
    if (wt_edges_bound(world, longer, k, a, b)) return 1;
  return 0;
}

// Is this path a part of the other one, and does that one stay? world: of which surfaces and wedges are there.
inline int wt_is_along(const wt_field_world* world, const wt_path* path, double length_m, const wt_path* other,
                       double other_m) {
  return other->depth > path->depth && fabs(length_m - other_m) <= WT_ALONG_LENGTH_M &&
         wt_is_part_of(world, path, other) && !wt_is_near(world, other);
}

#ifndef __OPENCL_VERSION__
}  // namespace wavetracer::device
#endif
#endif
