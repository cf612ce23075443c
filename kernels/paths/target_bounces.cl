// SPDX-License-Identifier: Apache-2.0
// target_bounces: paths that bounce within a body before or after one of its pieces scatters them: transmitter -
// mirrors of the body - piece - receiver, and the same the other way round. The points on the mirrors are exact (the
// image method). Legs are not tested.
#include "lib/count.clh"
#include "lib/prefetch.clh"
#include "lib/reflections.clh"
#include "lib/target_point.clh"
#include "wavetracer/device/points.h"
#pragma OPENCL FP_CONTRACT OFF

// A way from an end over the mirrors to the piece: the points on the mirrors, and the image of the end in all of them.
typedef struct {
  double3 points[WT_MOST_BOUNCES - 1], image;
} wt_bounced_way;

// Finds the way; returns the side from which it sees the piece, or 0 where there is no way. surfaces to instances: see
// wt_reflection_points.
inline uint find_bounces(const global wt_target_bounce* bounce, const global wt_target_point* point,
                         const global wt_exact_surface* surfaces, const global double* triangles,
                         const global wt_exact_instance* instances, double3 end, wt_bounced_way* way) {
  uint chain[WT_MOST_BOUNCES - 1];
  double3 images[WT_MOST_BOUNCES];
  images[0] = end;
  for (uint k = 0; k < bounce->count; ++k) {
    chain[k] = bounce->mirrors[k];
    images[k + 1] = wt_reflected(surfaces + chain[k], images[k]);
  }
  way->image = images[bounce->count];
  const double3 piece = wt_point_place(point);
  if (!(fabs(wt_above(surfaces + chain[bounce->count - 1], piece)) > WT_ON_SURFACE_M)) return 0;
  // The image is on the side from which the last leg comes, unless its mirror has no part there.
  if (!wt_seen_side(point, surfaces, way->image)) return 0;
  if (!wt_reflection_points(surfaces, triangles, instances, chain, bounce->count, images, piece, way->points)) return 0;
  return wt_seen_side(point, surfaces, way->points[bounce->count - 1]);
}

// Writes the row of a way, with its mirrors before the piece or, if it is turned, after it.
inline void write_bounces(const global wt_target_bounce* bounce, const wt_bounced_way* way, double3 piece, int turned,
                          global double* vertices, global uint* steps) {
  for (uint k = 0; k < bounce->count; ++k) {
    const uint at = turned ? bounce->count - k : k;
    vstore3(way->points[k], at, vertices);
    steps[at] = bounce->mirrors[k];
  }
  const uint at = turned ? 0 : bounce->count;
  vstore3(piece, at, vertices);
  steps[at] = WT_STEP_TARGET | bounce->point;
}

// A work-item takes rows_per_item of the rows from first_row to end_row - 1: every link meets every entry of bounces,
// from either end. counts, powers: as for targets (targets.cl).
kernel void target_bounces(const global uint2* links, const global wt_target_bounce* bounces,
                           const global wt_target_point* points, const global double* powers,
                           const global double4* transmitters, const global double4* receivers,
                           const global wt_exact_surface* surfaces, const global double* triangles,
                           const global wt_exact_instance* instances, global wt_solved* solved, global double* vertices,
                           global uint* sequences, global uint* counts, wt_target_bounces_arguments args) {
  const ulong begin = args.first_row + (ulong)get_global_id(0) * args.rows_per_item;
  const ulong end = min(begin + args.rows_per_item, args.end_row);
  uint weak = 0;
  for (ulong row = begin; row < end; ++row) {
    const uint2 link = links[row / (2 * (ulong)args.bounces)];
    const uint entry = (uint)(row % (2 * (ulong)args.bounces));
    const global wt_target_bounce* bounce = bounces + entry / 2;
    const global wt_target_point* point = points + bounce->point;
    const double4 from = transmitters[link.x], to = receivers[link.y];
    const int turned = entry & 1;
    if (!point->present || wt_carries(point, from) || wt_carries(point, to)) continue;
    const double3 other = turned ? from.xyz : to.xyz;
    const uint side = wt_seen_side(point, surfaces, other);
    wt_bounced_way way;
    if (!side ||
        !(find_bounces(bounce, point, surfaces, triangles, instances, turned ? to.xyz : from.xyz, &way) & side))
      continue;
    if (powers && wt_is_weak_by(point, powers[bounce->point], args.floor, way.image, other)) {
      ++weak;
      continue;
    }
    const uint slot = wt_take_places(counts, 1);
    if (slot >= args.capacity) continue;
    solved[slot].transmitter = link.x;
    solved[slot].receiver = link.y;
    solved[slot].depth = bounce->count + 1;
    solved[slot].blocked = 0;
    solved[slot].node = WT_NONE;
    solved[slot].quarters = WT_ALL_QUARTERS;
    const size_t at = (size_t)slot * args.max_depth;
    write_bounces(bounce, &way, wt_point_place(point), turned, vertices + 3 * at, sequences + at);
  }
  wt_count_weak(counts + 1, weak);
}
