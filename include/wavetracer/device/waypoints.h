// SPDX-License-Identifier: Apache-2.0
// The places where samples went, and the receivers that their rays passed: records of the passes waypoints and receive.
// A sample is one launched ray and all its segments.
#ifndef WAVETRACER_DEVICE_WAYPOINTS_H
#define WAVETRACER_DEVICE_WAYPOINTS_H
#include "wavetracer/device/records.h"

// Waypoint k of a sample is where its segment k began and segment k - 1 ended; a sample has a row of max_depth + 1 of
// them. The surface says of what kind it is: a reflection there, or one of these. A row ends with a miss or is full.
#define WT_WAYPOINT_LAUNCH 0xFFFFFFFEu
#define WT_WAYPOINT_MISS 0xFFFFFFFFu
typedef struct {
  float position[3];  // recentred metres; for a miss the direction in which the ray was lost
  wt_uint surface;
  wt_uint answered;  // 1: a ray cache answered the segment that ends here; 0: it was traced
} wt_waypoint;

// A segment that passed within the radius of a receiver.
typedef struct {
  wt_uint node;  // node in the set of sequences: the prefix of the ray
  wt_uint transmitter;
  wt_uint receiver;
  wt_uint sample;
  wt_uint depth;     // interactions before the segment
  float distance_m;  // distance of the receiver from the segment
} wt_reception;

#endif
