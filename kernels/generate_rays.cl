// generate_rays: the launch rays of one transmitter, a range of its launch indices, into a range of a ray queue.
// WT_DIRECTIONS names the map (wt_direction_hilbert, _fibonacci, _random); parameter is its step or seed, level and
// faces are those of hilbert.
#ifdef WT_CPU
#define WT_DIRECTION_WIDTH 16
#endif
#include "lib/hit.clh"
#include "wavetracer/device/directions.h"
#pragma OPENCL FP_CONTRACT OFF

#ifdef WT_CPU
// 16 rays a work-item. Queues are padded, so the last item may write past the count.
kernel void generate_rays(global float* rays, uint capacity, uint first_slot, uint count, ulong first_index,
                          ulong parameter, uint level, uint faces, float x, float y, float z, uint root) {
  const uint k = get_global_id(0) * 16;
  if (k >= count) return;
  const ulong16 lane = (ulong16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const wt_direction d = WT_DIRECTIONS(first_index + k + lane, (ulong16)parameter, level, faces);
  global float* r = rays + first_slot + k;
  const size_t plane = capacity;
  vstore16((float16)x, 0, r);
  vstore16((float16)y, 0, r + plane);
  vstore16((float16)z, 0, r + 2 * plane);
  vstore16(d.x, 0, r + 3 * plane);
  vstore16(d.y, 0, r + 4 * plane);
  vstore16(d.z, 0, r + 5 * plane);
  vstore16((float16)as_float(root), 0, r + 6 * plane);
  vstore16((float16)as_float(WT_NONE), 0, r + 7 * plane);
}
#else
kernel void generate_rays(global float* rays, uint capacity, uint first_slot, uint count, ulong first_index,
                          ulong parameter, uint level, uint faces, float x, float y, float z, uint root) {
  const uint k = get_global_id(0);
  if (k >= count) return;
  const wt_direction d = WT_DIRECTIONS(first_index + k, parameter, level, faces);
  const uint i = first_slot + k;
  wt_store_float3(rays, capacity, WT_RAY_ORIGIN, i, (float3)(x, y, z));
  wt_store_float3(rays, capacity, WT_RAY_DIRECTION, i, (float3)(d.x, d.y, d.z));
  wt_store_word(rays, capacity, WT_RAY_NODE, i, root);
  wt_store_word(rays, capacity, WT_RAY_SURFACE, i, WT_NONE);
}
#endif
