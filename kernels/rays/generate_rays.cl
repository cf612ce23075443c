// SPDX-License-Identifier: Apache-2.0
// generate_rays: writes the launch rays of one transmitter, for a range of its launch indices, into a range of a ray
// queue. A ray's number in the launch gives its quarter; `number` is that of the first ray.
// WT_PLACES names the map's places on the cylinder (wt_place_hilbert, _fibonacci, _random); WT_BY_TABLE is 1 where
// their heights are spread by a table, else 0. heights: the tables of horizon and of windows.
#ifdef WT_CPU
#define WT_LANES 16
#endif
#include "lib/hit.clh"
#include "lib/launch_ray.clh"
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
  const wt_window_ray ray = wt_launch_ray(index, map, heights, (uint16)from.heights, from.window, 0u);
  const wt_direction d = ray.along;
  wt_store16(rays, capacity, WT_RAY_ORIGIN, slot, from.origin[0] + ray.start.x);
  wt_store16(rays, capacity, WT_RAY_ORIGIN + 1, slot, from.origin[1] + ray.start.y);
  wt_store16(rays, capacity, WT_RAY_ORIGIN + 2, slot, from.origin[2] + ray.start.z);
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
  const wt_window_ray ray = wt_launch_ray(index, map, heights, from.heights, from.window, 0u);
  const wt_direction d = ray.along;
  wt_store_float3(rays, capacity, WT_RAY_ORIGIN, slot,
                  (float3)(from.origin[0] + ray.start.x, from.origin[1] + ray.start.y, from.origin[2] + ray.start.z));
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

// The same for several launchers, `count` rays each, one launcher after the other. On CPUs count is a multiple of 16.
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

// Launches the indices first_index + order[k], which are also the numbers in the launch. So a launch in an order of its
// own moves no rays.
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
// The launcher of a sample: two float4 with its origin and, as words, its root, its source, the place of its table and
// whether that is a window.
inline uint launcher_word(const global float4* launchers, uint launcher, uint word) {
  return as_uint(((const global float*)launchers)[8 * launcher + 4 + word]);
}

// The ray of a sample, turned about z, or within its window, by the angle of the launch.
inline wt_window_ray sample_ray(WT_U64 cell, wt_map_arguments map, const global float* heights, WT_U32 table,
                                uint window, wt_samples_arguments args) {
  wt_window_ray out = wt_launch_ray(cell, map, heights, table, window, args.turn);
  if (window) return out;
  const wt_direction d = out.along;
  out.along.x = args.cosine * d.x - args.sine * d.y;
  out.along.y = args.sine * d.x + args.cosine * d.y;
  return out;
}

inline void store_sample(global float* rays, uint slot, uint sample, const global uint* samples,
                         const global float4* launchers, float3 start, float3 along, global uint* ends,
                         wt_samples_arguments args) {
  const uint launcher = samples[args.sample_capacity + sample], root = launcher_word(launchers, launcher, 0);
  wt_store_float3(rays, args.capacity, WT_RAY_ORIGIN, slot, launchers[2 * launcher].xyz + start);
  wt_store_float3(rays, args.capacity, WT_RAY_DIRECTION, slot, along);
  wt_store_word(rays, args.capacity, WT_RAY_NODE, slot, wt_with_quarter(root, samples[sample]));
  wt_store_word(rays, args.capacity, WT_RAY_SURFACE, slot, launcher_word(launchers, launcher, 1));
  wt_store_word(rays, args.capacity, WT_RAY_SAMPLE, slot, sample);
  ends[sample] = root;
}

// Launches the samples of a list into the slots of an empty queue. A sample is a cell of the launch directions
// (samples[i]) and a launcher (samples[sample_capacity + i]). A sample's quarter is that of its cell. ends[i] becomes
// the root: no ray of the sample has hit anything yet.
kernel void generate_samples(global float* rays, const global uint* samples, const global float4* launchers,
                             const global float* heights, global uint* ends, wt_map_arguments map,
                             wt_samples_arguments args) {
  const uint k = get_global_id(0) * WT_RAYS_PER_ITEM;
  if (k >= args.count) return;
#ifdef WT_CPU
  const uint count = min(16u, args.count - k);
  uint tables[16] = {0}, windows[16] = {0}, any[2] = {0, 0};
  for (uint j = 0; j < count; ++j) {
    const uint launcher = samples[args.sample_capacity + args.first + k + j];
    tables[j] = launcher_word(launchers, launcher, 2);
    windows[j] = launcher_word(launchers, launcher, 3);
    any[windows[j] != 0u] = 1;
  }
  const ulong16 cells = listed(0, samples + args.first + k);
  for (uint window = 0; window < 2; ++window) {
    if (!any[window]) continue;
    const wt_window_ray ray = sample_ray(cells, map, heights, vload16(0, tables), window, args);
    float along[3][16], start[3][16];
    vstore16(ray.along.x, 0, along[0]), vstore16(ray.along.y, 0, along[1]), vstore16(ray.along.z, 0, along[2]);
    vstore16(ray.start.x, 0, start[0]), vstore16(ray.start.y, 0, start[1]), vstore16(ray.start.z, 0, start[2]);
    for (uint j = 0; j < count; ++j)
      if ((windows[j] != 0u) == window)
        store_sample(rays, k + j, args.first + k + j, samples, launchers,
                     (float3)(start[0][j], start[1][j], start[2][j]), (float3)(along[0][j], along[1][j], along[2][j]),
                     ends, args);
  }
#else
  const uint sample = args.first + k, launcher = samples[args.sample_capacity + sample];
  const wt_window_ray ray = sample_ray(listed(0, samples + sample), map, heights, launcher_word(launchers, launcher, 2),
                                       launcher_word(launchers, launcher, 3), args);
  store_sample(rays, k, sample, samples, launchers, (float3)(ray.start.x, ray.start.y, ray.start.z),
               (float3)(ray.along.x, ray.along.y, ray.along.z), ends, args);
#endif
}
#endif
