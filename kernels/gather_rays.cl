// gather_rays: the rays of a queue into another, in the order of a permutation: slot i takes ray order[i].
// Both queues have the same capacity.
#include "wavetracer/device/records.h"

kernel void gather_rays(const global float* rays, uint capacity, uint count, const global uint* order,
                        global float* next) {
  const uint i = get_global_id(0);
  if (i >= count) return;
  const uint from = order[i];
  for (size_t plane = 0; plane < WT_RAY_PLANES; ++plane) next[plane * capacity + i] = rays[plane * capacity + from];
}
