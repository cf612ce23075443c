// occlusion: is a leg of a solved path obstructed? Hits come from the watertight float32 traversal, in order; each is
// judged in double: a surface blocks when the leg's ends lie on opposite sides of its plane, both farther from it than
// the tolerance.
#include "lib/bvh2.clh"
#include "lib/bvh8.clh"
#include "lib/images.clh"
#include "lib/moving.clh"
#pragma OPENCL FP_CONTRACT OFF

#ifdef WT_SHAPE_BVH2
#define WT_NODE float4
#define WT_NEXT_STATIC(o, d, t_min, after, t_max) \
  wt_nearest_bvh2(nodes, triangles, triangle_slots, o, d, t_min, after, t_max, WT_NONE)
#else
#define WT_NODE float
#define WT_NEXT_STATIC(o, d, t_min, after, t_max) \
  wt_nearest_bvh8(nodes, triangles, extent_m, o, d, t_min, after, t_max, WT_NONE)
#endif

// An end closer than this to a surface's plane is on that surface and is not hidden by it: ten times the float32
// rounding of coordinates of a kilometre, and less than any wall is thick.
#define WT_ON_SURFACE_M 1e-4

inline int blocks(const global wt_exact_surface* s, double3 from, double3 to) {
  const double a = wt_above(s, from), b = wt_above(s, to);
  return ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)) && fabs(a) > WT_ON_SURFACE_M && fabs(b) > WT_ON_SURFACE_M;
}

kernel void occlusion(const global WT_NODE* nodes, const global WT_NODE* triangles, uint triangle_slots, float extent_m,
                      const global float4* moving, const global double4* transmitters, const global double4* receivers,
                      const global wt_exact_surface* surfaces, uint solved_count, uint max_depth,
                      global wt_solved* solved, const global double* vertices, const global uint* sequences) {
  const uint i = get_global_id(0) / (max_depth + 1), leg = get_global_id(0) % (max_depth + 1);
  if (i >= solved_count || leg > solved[i].depth) return;
  const uint depth = solved[i].depth;
  const global double* v = vertices + 3 * ((size_t)i * max_depth + leg);
  const double3 from = leg == 0 ? transmitters[solved[i].transmitter].xyz : (double3)(v[-3], v[-2], v[-1]);
  const double3 to = leg == depth ? receivers[solved[i].receiver].xyz : (double3)(v[0], v[1], v[2]);
  const uint source = leg == 0 ? WT_NONE : sequences[(size_t)i * max_depth + leg - 1];
  const uint goal = leg == depth ? WT_NONE : sequences[(size_t)i * max_depth + leg];

  // Legs of a path follow each other, and most paths are obstructed: a leg that was found so spares the others. One
  // that comes too soon to see it does no harm.
  if (wt_load_relaxed_u32(&solved[i].blocked)) return;
  const double length = sqrt(wt_dot(to - from, to - from));
  if (!(length > 0.0)) return;
  const float3 o = (float3)((float)from.x, (float)from.y, (float)from.z);
  const float3 d =
      (float3)((float)((to.x - from.x) / length), (float)((to.y - from.y) / length), (float)((to.z - from.z) / length));
  const float t_max = (float)length;
  // The vehicles that carry the antennas hide nothing from them.
  const uint own_from = leg == 0 ? wt_end_instance(transmitters[solved[i].transmitter]) : WT_NONE;
  const uint own_to = leg == depth ? wt_end_instance(receivers[solved[i].receiver]) : WT_NONE;
  float t = 0.0f;
  uint after = WT_NONE;
  for (;;) {
    wt_hit hit = WT_NEXT_STATIC(o, d, t, after, t_max);
#ifdef WT_INSTANCES
    wt_visit_moving(moving, extent_m, o, d, t, after, WT_NONE, own_from, own_to, &hit);
#endif
    if (hit.primitive == WT_NONE) return;
    if (hit.surface != source && hit.surface != goal && blocks(surfaces + hit.surface, from, to)) {
      atomic_or(&solved[i].blocked, 1u);
      return;
    }
    t = hit.t;
    after = hit.primitive;
  }
}
