// generate_rays: the launch rays of one transmitter, a range of its launch indices, into a range of a ray queue.
// A ray's number in the launch, of which `number` is that of the first, says its quarter.
// WT_DIRECTIONS names the map (wt_direction_horizon, _hilbert, _fibonacci, _random); heights are those of horizon.
#ifdef WT_CPU
#define WT_LANES 16
#endif
#include "lib/hit.clh"
#include "wavetracer/device/arguments.h"
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

inline void store_rays(global float* rays, uint capacity, uint slot, ulong16 index, uint16 number, wt_map_arguments map,
                       const global float* heights, wt_launcher_arguments from) {
  const wt_direction d =
      WT_DIRECTIONS(index, (ulong16)map.parameter, map.level, map.faces, heights, (uint16)from.heights);
  for (uint axis = 0; axis < 3; ++axis)
    wt_store16(rays, capacity, WT_RAY_ORIGIN + axis, slot, (float16)from.origin[axis]);
  wt_store16(rays, capacity, WT_RAY_DIRECTION, slot, d.x);
  wt_store16(rays, capacity, WT_RAY_DIRECTION + 1, slot, d.y);
  wt_store16(rays, capacity, WT_RAY_DIRECTION + 2, slot, d.z);
  wt_store16(rays, capacity, WT_RAY_NODE, slot, as_float16(from.root | (number & 3u) << WT_QUARTER_SHIFT));
  wt_store16(rays, capacity, WT_RAY_SURFACE, slot, (float16)as_float(from.source));
}
#else
#define WT_RAYS_PER_ITEM 1
inline ulong after(ulong index, ulong stride) { return index; }
inline ulong listed(ulong index, const global uint* list) { return index + list[0]; }
inline uint numbered(uint number) { return number; }

inline void store_rays(global float* rays, uint capacity, uint slot, ulong index, uint number, wt_map_arguments map,
                       const global float* heights, wt_launcher_arguments from) {
  const wt_direction d = WT_DIRECTIONS(index, map.parameter, map.level, map.faces, heights, from.heights);
  wt_store_float3(rays, capacity, WT_RAY_ORIGIN, slot, (float3)(from.origin[0], from.origin[1], from.origin[2]));
  wt_store_float3(rays, capacity, WT_RAY_DIRECTION, slot, (float3)(d.x, d.y, d.z));
  wt_store_word(rays, capacity, WT_RAY_NODE, slot, wt_with_quarter(from.root, number));
  wt_store_word(rays, capacity, WT_RAY_SURFACE, slot, from.source);
}
#endif

kernel void generate_rays(global float* rays, const global float* heights, wt_map_arguments map,
                          wt_launcher_arguments from, wt_launch_arguments args) {
  const uint k = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (k >= args.count) return;
  store_rays(rays, args.capacity, args.first_slot + k, after(args.first_index + args.stride * k, args.stride),
             numbered(args.number + k), map, heights, from);
}

// The same of several launchers, `count` rays each, one launcher after the other. On CPUs count is a multiple of 16.
kernel void generate_launchers(global float* rays, const global float* heights, wt_map_arguments map,
                               const global wt_launcher_arguments* launchers, uint launcher_count,
                               wt_launch_arguments args) {
  const uint items = args.count / WT_RAYS_PER_ITEM, launcher = get_global_id(0) / items;
  if (launcher >= launcher_count) return;
  const uint k = get_global_id(0) % items * WT_RAYS_PER_ITEM;
  store_rays(rays, args.capacity, args.first_slot + launcher * args.count + k,
             after(args.first_index + args.stride * k, args.stride), numbered(args.number + k), map, heights,
             launchers[launcher]);
}

// Launch indices first_index + order[k], which are numbers in the launch, too: a launch in an order of its own costs no
// move of rays.
kernel void generate_ordered(global float* rays, const global uint* order, const global float* heights,
                             wt_map_arguments map, wt_launcher_arguments from, wt_launch_arguments args) {
  const uint k = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (k >= args.count) return;
#ifdef WT_CPU
  const ulong16 index = listed(args.first_index, order + k);
  const uint16 number = convert_uint16(index);
#else
  const ulong index = listed(args.first_index, order + k);
  const uint number = (uint)index;
#endif
  store_rays(rays, args.capacity, args.first_slot + k, index, number, map, heights, from);
}

#ifdef WT_SAMPLES
// Samples of a list into the slots of an empty queue. A sample is a cell of the launch
// directions (samples[i]) and a launcher (samples[sample_capacity + i]); launchers: origin and, as words, root, source
// and the place of its table (two float4 each). A sample's quarter is that of its cell. ends[i] becomes the root: no
// ray of the sample has hit anything yet.
kernel void generate_samples(global float* rays, const global uint* samples, const global float4* launchers,
                             const global float* heights, global uint* ends, wt_map_arguments map,
                             wt_samples_arguments args) {
  const uint k = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (k >= args.count) return;
#ifdef WT_CPU
  uint tables[16] = {0};
  for (uint j = 0; j < 16 && k + j < args.count; ++j)
    tables[j] = as_uint(launchers[2 * samples[args.sample_capacity + args.first + k + j] + 1].z);
  const wt_direction d = WT_DIRECTIONS(listed(0, samples + args.first + k), (ulong16)map.parameter, map.level,
                                       map.faces, heights, vload16(0, tables));
  float x[16], y[16], z[16];
  vstore16(args.cosine * d.x - args.sine * d.y, 0, x);
  vstore16(args.sine * d.x + args.cosine * d.y, 0, y);
  vstore16(d.z, 0, z);
#else
  const uint table = as_uint(launchers[2 * samples[args.sample_capacity + args.first + k] + 1].z);
  const wt_direction d =
      WT_DIRECTIONS(listed(0, samples + args.first + k), map.parameter, map.level, map.faces, heights, table);
  const float3 turned = (float3)(args.cosine * d.x - args.sine * d.y, args.sine * d.x + args.cosine * d.y, d.z);
#endif
  for (uint j = 0; j < WT_RAYS_PER_ITEM && k + j < args.count; ++j) {
    const uint sample = args.first + k + j;
    const global float4* launcher = launchers + 2 * samples[args.sample_capacity + sample];
    const uint root = as_uint(launcher[1].x);
    wt_store_float3(rays, args.capacity, WT_RAY_ORIGIN, k + j, launcher[0].xyz);
#ifdef WT_CPU
    wt_store_float3(rays, args.capacity, WT_RAY_DIRECTION, k + j, (float3)(x[j], y[j], z[j]));
#else
    wt_store_float3(rays, args.capacity, WT_RAY_DIRECTION, k + j, turned);
#endif
    wt_store_word(rays, args.capacity, WT_RAY_NODE, k + j, wt_with_quarter(root, samples[sample]));
    wt_store_word(rays, args.capacity, WT_RAY_SURFACE, k + j, as_uint(launcher[1].y));
    wt_store_word(rays, args.capacity, WT_RAY_SAMPLE, k + j, sample);
    ends[sample] = root;
  }
}
#endif
