// SPDX-License-Identifier: Apache-2.0
// waypoints: the places where the segments of a queue begin and end, one row for each sample, and the rows of chosen
// samples side by side. Rows have `stride` waypoints; the queue is labelled.
#include "lib/hit.clh"
#include "wavetracer/device/waypoints.h"
#pragma OPENCL FP_CONTRACT OFF

inline void store_waypoint(global wt_waypoint* to, float3 position, uint surface, uint answered) {
  to->position[0] = position.x;
  to->position[1] = position.y;
  to->position[2] = position.z;
  to->surface = surface;
  to->answered = answered;
}

// One ray per work-item. depth: interactions of the rays so far. Samples count from first_sample. traced[i]: WT_NONE
// where a ray cache answered ray i; traced is null without a cache.
kernel void waypoints(const global float* rays, const global float* hits, const global float* traced, uint capacity,
                      uint ray_count, uint first_sample, uint depth, uint stride, global wt_waypoint* out) {
  const uint i = get_global_id(0);
  if (i >= ray_count) return;
  const float3 o = wt_load_float3(rays, capacity, WT_RAY_ORIGIN, i),
               d = wt_load_float3(rays, capacity, WT_RAY_DIRECTION, i);
  const uint sample = wt_load_word(rays, capacity, WT_RAY_SAMPLE, i) - first_sample;
  const uint surface = wt_load_word(hits, capacity, WT_HIT_SURFACE, i);
  global wt_waypoint* row = out + (size_t)sample * stride;
  if (depth == 0) store_waypoint(row, o, WT_WAYPOINT_LAUNCH, 0u);
  if (depth + 1 >= stride) return;
  const float t = hits[i];
  const uint answered = traced && as_uint(traced[i]) == WT_NONE;
  if (surface == WT_NONE)
    store_waypoint(row + depth + 1, d, WT_WAYPOINT_MISS, answered);
  else
    store_waypoint(row + depth + 1, (float3)(fma(t, d.x, o.x), fma(t, d.y, o.y), fma(t, d.z, o.z)), surface, answered);
}

// Copies row list[k] to row k of `out`. One waypoint per work-item.
kernel void gather_waypoints(const global wt_waypoint* rows, const global uint* list, uint count, uint stride,
                             global wt_waypoint* out) {
  const size_t i = get_global_id(0);
  if (i < (size_t)count * stride) out[i] = rows[(size_t)list[i / stride] * stride + i % stride];
}
