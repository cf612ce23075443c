// SPDX-License-Identifier: Apache-2.0
// vegetation: computes the metres of each visible path inside of each kind of vegetation, over all of its legs. Where
// volumes overlap, the space belongs to the first. Consumes visible paths and the tree over the volumes; writes
// wt_vegetation_arguments::kinds lengths per path.
#include "lib/count.clh"
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/bvh.h"
#include "wavetracer/device/volumes.h"
#pragma OPENCL FP_CONTRACT OFF

// Does a leg meet a box? The box is larger than its contents by more than this rounds.
inline int wt_leg_meets(double3 from, double3 over, wt_planes_xy xy, const float* z) {
  const double3 lower = ((double3)(xy.x[0], xy.y[0], z[0]) - from) * over;
  const double3 upper = ((double3)(xy.x[1], xy.y[1], z[1]) - from) * over;
  const double3 first = fmin(lower, upper), last = fmax(lower, upper);
  return fmax(fmax(fmax(first.x, first.y), first.z), 0.0) <= fmin(fmin(fmin(last.x, last.y), last.z), 1.0) &&
         xy.x[0] <= xy.x[1];
}

// The reciprocal of a component of a direction, large where that is 0, so that no product is undefined.
inline double wt_over(double x) { return fabs(x) > 1e-30 ? 1.0 / x : 1e30; }

// One path per work-item.
kernel void vegetation(const global wt_bvh2_node* nodes, const global wt_volume* volumes,
                       const global double* triangles, const global uint* earlier, const global double4* transmitters,
                       const global double4* receivers, const global wt_solved* visible, const global double* vertices,
                       const global wt_counters* counters, global double* lengths, wt_vegetation_arguments args) {
  const uint i = get_global_id(0);
  if (i >= wt_length(counters, args.visible_counter, args.visible_count)) return;
  ulong inside[WT_MOST_KINDS];
  for (uint kind = 0; kind < WT_MOST_KINDS; ++kind) inside[kind] = 0;
  wt_volumes all;
  all.volumes = volumes;
  all.triangles = triangles;
  all.earlier = earlier;
  const global double* v = vertices + 3 * (size_t)args.max_depth * i;
  const uint depth = visible[i].depth;
  double3 from = transmitters[visible[i].transmitter].xyz;
  for (uint leg = 0; leg <= depth; ++leg) {
    const double3 to = leg < depth ? wt_vector(v + 3 * leg) : receivers[visible[i].receiver].xyz;
    const double3 along = to - from, over = (double3)(wt_over(along.x), wt_over(along.y), wt_over(along.z));
    int stack[40];  // large enough, since the tree is balanced
    uint waiting = 0;
    for (int next = 0;;) {
      const wt_bvh2_node node = nodes[next];
      for (uint side = 0; side < 2; ++side) {
        if (!(side == 0 ? wt_leg_meets(from, over, node.left, node.left_z)
                        : wt_leg_meets(from, over, node.right, node.right_z)))
          continue;
        const int child = node.child[side];
        if (child >= 0) {
          stack[waiting++] = child;
          continue;
        }
        for (uint k = wt_leaf_first(child); k < wt_leaf_end(child); ++k)
          inside[volumes[k].kind] += wt_parts_of_length(wt_length_in_space(all, k, from, to));
      }
      if (waiting == 0) break;
      next = stack[--waiting];
    }
    from = to;
  }
  for (uint kind = 0; kind < args.kinds; ++kind)
    lengths[(size_t)i * args.kinds + kind] = wt_length_of_parts(inside[kind]);
}
