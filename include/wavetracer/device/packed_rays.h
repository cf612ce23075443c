// SPDX-License-Identifier: Apache-2.0
// Rays and hits as records, one after the other, for programs that do not keep them in planes (records.h).
#ifndef WAVETRACER_DEVICE_PACKED_RAYS_H
#define WAVETRACER_DEVICE_PACKED_RAYS_H
#include "wavetracer/device/types.h"

// A ray meets what lies at origin + t * direction with t_min < t <= t_max. The direction may have any length but 0.
typedef struct {
  float origin[3];
  float t_min;
  float direction[3];
  float t_max;
} wt_packed_ray;

// A hit: the triangle `primitive`, WT_NONE where there is none, and its point
// (1 - u - v) * first corner + u * second corner + v * third corner.
typedef struct {
  float t;  // infinite where there is none
  wt_uint primitive;
  float u, v;  // 0 where there is none
} wt_packed_hit;

#endif
