// SPDX-License-Identifier: Apache-2.0
// gather_rays: copies rays of a queue to another: slot i gets ray order[i]. order is a permutation, or lists some of
// the rays.
// Both queues have the same capacity. A work-item copies WT_RAYS_PER_ITEM rays, plane by plane (1 on GPUs).
#include "wavetracer/device/records.h"

kernel void gather_rays(const global float* rays, uint capacity, uint count, const global uint* order,
                        global float* next, uint plane_count) {
  const uint first = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (first >= count) return;
  const uint end = first + min((uint)WT_RAYS_PER_ITEM, count - first);
  for (size_t plane = 0; plane < plane_count; ++plane)
    for (uint i = first; i < end; ++i) next[plane * capacity + i] = rays[plane * capacity + order[i]];
}
