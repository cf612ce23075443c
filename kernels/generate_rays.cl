// generate_rays: the launch rays of one transmitter, a range of its launch indices, into a range of a ray queue.
// A ray's number in the launch, of which `number` is that of the first, says its quarter.
// WT_DIRECTIONS names the map (wt_direction_horizon, _hilbert, _fibonacci, _random); parameter is its step or seed,
// level and faces are those of the Hilbert curve, heights and table (its first place there) the heights of horizon.
#ifdef WT_CPU
#define WT_LANES 16
#endif
#include "lib/hit.clh"
#include "wavetracer/device/directions.h"
#pragma OPENCL FP_CONTRACT OFF

#ifdef WT_CPU
// 16 rays per work-item. Queues and lists are padded, so the last item may pass the count.
#define WT_RAYS_PER_ITEM 16
inline ulong16 after(ulong index, ulong stride) {
  return index + stride * (ulong16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
inline ulong16 listed(ulong index, const global uint* list) { return index + convert_ulong16(vload16(0, list)); }
inline uint16 numbered(uint number) { return number + (uint16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15); }

inline void store_rays(global float* rays, uint capacity, uint slot, ulong16 index, uint16 number, ulong parameter,
                       uint level, uint faces, const global float* heights, uint table, float x, float y, float z,
                       uint root, uint source) {
  const wt_direction d = WT_DIRECTIONS(index, (ulong16)parameter, level, faces, heights, (uint16)table);
  global float* r = rays + slot;
  const size_t plane = capacity;
  vstore16((float16)x, 0, r);
  vstore16((float16)y, 0, r + plane);
  vstore16((float16)z, 0, r + 2 * plane);
  vstore16(d.x, 0, r + 3 * plane);
  vstore16(d.y, 0, r + 4 * plane);
  vstore16(d.z, 0, r + 5 * plane);
  vstore16(as_float16(root | (number & 3u) << WT_QUARTER_SHIFT), 0, r + 6 * plane);
  vstore16((float16)as_float(source), 0, r + 7 * plane);
}
#else
#define WT_RAYS_PER_ITEM 1
inline ulong after(ulong index, ulong stride) { return index; }
inline ulong listed(ulong index, const global uint* list) { return index + list[0]; }
inline uint numbered(uint number) { return number; }

inline void store_rays(global float* rays, uint capacity, uint slot, ulong index, uint number, ulong parameter,
                       uint level, uint faces, const global float* heights, uint table, float x, float y, float z,
                       uint root, uint source) {
  const wt_direction d = WT_DIRECTIONS(index, parameter, level, faces, heights, table);
  wt_store_float3(rays, capacity, WT_RAY_ORIGIN, slot, (float3)(x, y, z));
  wt_store_float3(rays, capacity, WT_RAY_DIRECTION, slot, (float3)(d.x, d.y, d.z));
  wt_store_word(rays, capacity, WT_RAY_NODE, slot, root | (number & 3u) << WT_QUARTER_SHIFT);
  wt_store_word(rays, capacity, WT_RAY_SURFACE, slot, source);
}
#endif

// Launch indices first_index + stride * k into slots first_slot + k. source: what the rays leave, WT_OWN and the
// instance that carries the antenna, or WT_NONE.
kernel void generate_rays(global float* rays, uint capacity, uint first_slot, uint count, ulong first_index,
                          ulong stride, uint number, ulong parameter, uint level, uint faces,
                          const global float* heights, uint table, float x, float y, float z, uint root, uint source) {
  const uint k = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (k >= count) return;
  store_rays(rays, capacity, first_slot + k, after(first_index + stride * k, stride), numbered(number + k), parameter,
             level, faces, heights, table, x, y, z, root, source);
}

// Launch indices first_index + order[k], which are numbers in the launch, too: a launch in an order of its own costs no
// move of rays.
kernel void generate_ordered(global float* rays, uint capacity, uint first_slot, uint count, ulong first_index,
                             const global uint* order, ulong parameter, uint level, uint faces,
                             const global float* heights, uint table, float x, float y, float z, uint root,
                             uint source) {
  const uint k = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (k >= count) return;
#ifdef WT_CPU
  const ulong16 index = listed(first_index, order + k);
  const uint16 number = convert_uint16(index);
#else
  const ulong index = listed(first_index, order + k);
  const uint number = (uint)index;
#endif
  store_rays(rays, capacity, first_slot + k, index, number, parameter, level, faces, heights, table, x, y, z, root,
             source);
}

#ifdef WT_SAMPLES
// Samples first .. first + count - 1 of a list into the slots of an empty queue. A sample is a cell of the launch
// directions (samples[i]) and a launcher (samples[sample_capacity + i]); launchers: origin and, as words, root, source
// and the place of its table (two float4 each). A sample's quarter is that of its cell. Directions are turned about z
// by the angle of this cosine and sine. ends[i] becomes the root: no ray of the sample has hit anything yet.
kernel void generate_samples(global float* rays, uint capacity, uint first, uint count, const global uint* samples,
                             uint sample_capacity, const global float4* launchers, ulong parameter, uint level,
                             uint faces, const global float* heights, float cosine, float sine, global uint* ends) {
  const uint k = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (k >= count) return;
#ifdef WT_CPU
  uint tables[16] = {0};
  for (uint j = 0; j < 16 && k + j < count; ++j)
    tables[j] = as_uint(launchers[2 * samples[sample_capacity + first + k + j] + 1].z);
  const wt_direction d =
      WT_DIRECTIONS(listed(0, samples + first + k), (ulong16)parameter, level, faces, heights, vload16(0, tables));
  float x[16], y[16], z[16];
  vstore16(cosine * d.x - sine * d.y, 0, x);
  vstore16(sine * d.x + cosine * d.y, 0, y);
  vstore16(d.z, 0, z);
#else
  const uint table = as_uint(launchers[2 * samples[sample_capacity + first + k] + 1].z);
  const wt_direction d = WT_DIRECTIONS(listed(0, samples + first + k), parameter, level, faces, heights, table);
  const float3 turned = (float3)(cosine * d.x - sine * d.y, sine * d.x + cosine * d.y, d.z);
#endif
  for (uint j = 0; j < WT_RAYS_PER_ITEM && k + j < count; ++j) {
    const uint sample = first + k + j;
    const global float4* launcher = launchers + 2 * samples[sample_capacity + sample];
    const uint root = as_uint(launcher[1].x);
    wt_store_float3(rays, capacity, WT_RAY_ORIGIN, k + j, launcher[0].xyz);
#ifdef WT_CPU
    wt_store_float3(rays, capacity, WT_RAY_DIRECTION, k + j, (float3)(x[j], y[j], z[j]));
#else
    wt_store_float3(rays, capacity, WT_RAY_DIRECTION, k + j, turned);
#endif
    wt_store_word(rays, capacity, WT_RAY_NODE, k + j, root | (samples[sample] & 3u) << WT_QUARTER_SHIFT);
    wt_store_word(rays, capacity, WT_RAY_SURFACE, k + j, as_uint(launcher[1].y));
    wt_store_word(rays, capacity, WT_RAY_SAMPLE, k + j, sample);
    ends[sample] = root;
  }
}
#endif
