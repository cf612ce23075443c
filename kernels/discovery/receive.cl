// SPDX-License-Identifier: Apache-2.0
// receive: finds rays that pass within a radius of receivers that their transmitter has links to. A segment ends where
// the ray hits something, or never. The queue is labelled; a work-item takes one ray, and 16 receivers at once. With
// WT_ANSWERED a ray cache answered some rays, and then it also says which receivers they pass.
#include "lib/hit.clh"
#include "lib/trie.clh"
#include "wavetracer/device/arguments.h"
#include "wavetracer/device/waypoints.h"
#pragma OPENCL FP_CONTRACT OFF

typedef struct {
  float3 origin, direction;
  float length;
} segment;

// receivers: three planes of `capacity` floats, from the first of the 16 on. *along: the distance from the segment's
// start to its point nearest to each receiver; *apart: the squared distance of the receiver from that point.
inline void nearest_points(segment s, const global float* receivers, uint capacity, float16* along, float16* apart) {
  const float16 x = vload16(0, receivers) - s.origin.x, y = vload16(0, receivers + capacity) - s.origin.y;
  const float16 z = vload16(0, receivers + 2 * (size_t)capacity) - s.origin.z;
  *along = clamp(fma(x, s.direction.x, fma(y, s.direction.y, z * s.direction.z)), 0.0f, s.length);
  const float16 dx = fma(-*along, s.direction.x, x), dy = fma(-*along, s.direction.y, y);
  const float16 dz = fma(-*along, s.direction.z, z);
  *apart = fma(dx, dx, fma(dy, dy, dz * dz));
}

inline uint within(float16 apart, float radius_m) {
  int inside[16];
  vstore16(apart <= radius_m * radius_m, 0, inside);
  uint mask = 0;
  for (int k = 0; k < 16; ++k) mask |= (inside[k] != 0 ? 1u : 0u) << k;
  return mask;
}

inline segment load_segment(const global float* rays, const global float* hits, uint capacity, uint i) {
  const segment s = {wt_load_float3(rays, capacity, WT_RAY_ORIGIN, i),
                     wt_load_float3(rays, capacity, WT_RAY_DIRECTION, i),
                     wt_load_word(hits, capacity, WT_HIT_PRIMITIVE, i) == WT_NONE ? INFINITY : hits[i]};
  return s;
}

// counter: receptions so far; those without room are counted, too.
inline void append(const global float* rays, uint capacity, uint i, uint receiver, uint depth, float distance_m,
                   global wt_reception* out, uint out_capacity, global uint* counter) {
  const uint slot = atomic_inc(counter);
  if (slot >= out_capacity) return;
  const wt_reception r = {wt_node_of(wt_load_word(rays, capacity, WT_RAY_NODE, i)),
                          wt_load_word(rays, capacity, WT_RAY_REGION, i),
                          receiver,
                          wt_load_word(rays, capacity, WT_RAY_SAMPLE, i),
                          depth,
                          distance_m};
  out[slot] = r;
}

// links: a mask of the wanted receivers for each transmitter and 16 receivers. answered: the receivers that the cache
// gave; traced[i] is WT_NONE where ray i was answered.
kernel void receive(const global float* rays, const global float* hits, const global float* receivers,
                    const global ushort* links, global wt_reception* out, global uint* counter,
                    const global uint* traced, const global uint* answered, wt_receive_arguments args) {
  const uint i = get_global_id(0);
  if (i >= args.ray_count) return;
  const segment s = load_segment(rays, hits, args.capacity, i);
  float16 along, apart;
  float apart_of[16];
#ifdef WT_ANSWERED
  if (traced[i] == WT_NONE) {
    const uint receiver = answered[i];
    if (receiver == WT_NONE) return;
    nearest_points(s, receivers + receiver / 16 * 16, args.receiver_capacity, &along, &apart);
    vstore16(apart, 0, apart_of);
    append(rays, args.capacity, i, receiver, args.depth, sqrt(apart_of[receiver % 16]), out, args.out_capacity,
           counter);
    return;
  }
#endif
  const uint groups = args.receiver_capacity / 16;
  const global ushort* wanted = links + (size_t)wt_load_word(rays, args.capacity, WT_RAY_REGION, i) * groups;
  for (uint group = 0; group < groups; ++group) {
    if (wanted[group] == 0) continue;
    nearest_points(s, receivers + 16 * group, args.receiver_capacity, &along, &apart);
    uint passed = wanted[group] & within(apart, args.radius_m);
    if (passed == 0) continue;
    vstore16(apart, 0, apart_of);
    for (; passed; passed &= passed - 1) {
      const uint k = popcount((passed & (~passed + 1)) - 1u);
      append(rays, args.capacity, i, 16 * group + k, args.depth, sqrt(apart_of[k]), out, args.out_capacity, counter);
    }
  }
}

// Sets first[i] to the wanted receiver whose sphere ray i enters first (the lowest of equals), or WT_NONE. A cache
// stores that for a segment.
kernel void first_receiver(const global float* rays, const global float* hits, const global float* receivers,
                           const global ushort* links, global uint* first, wt_receive_arguments args) {
  const uint i = get_global_id(0);
  if (i >= args.ray_count) return;
  const segment s = load_segment(rays, hits, args.capacity, i);
  const uint groups = args.receiver_capacity / 16;
  const global ushort* wanted = links + (size_t)wt_load_word(rays, args.capacity, WT_RAY_REGION, i) * groups;
  uint nearest = WT_NONE;
  float nearest_m = INFINITY;
  for (uint group = 0; group < groups; ++group) {
    if (wanted[group] == 0) continue;
    float16 along, apart;
    nearest_points(s, receivers + 16 * group, args.receiver_capacity, &along, &apart);
    uint passed = wanted[group] & within(apart, args.radius_m);
    if (passed == 0) continue;
    float entry_m[16];
    vstore16(along - sqrt(fmax(args.radius_m * args.radius_m - apart, 0.0f)), 0, entry_m);
    for (; passed; passed &= passed - 1) {
      const uint k = popcount((passed & (~passed + 1)) - 1u);
      if (entry_m[k] >= nearest_m) continue;
      nearest_m = entry_m[k];
      nearest = 16 * group + k;
    }
  }
  first[i] = nearest;
}
