// SPDX-License-Identifier: Apache-2.0
// The layout of what moves, one definition for C++ (host/passes/place.cpp) and OpenCL C (kernels/vehicles/top_level.cl,
// kernels/lib/moving*.clh): one buffer of float4 with a head, the top-level tree of the frame, its instances, and the
// trees of all models. Traversal has two levels: the top level in scene coordinates, then the ray in the coordinates of
// a model.
#ifndef WAVETRACER_DEVICE_MOVING_H
#define WAVETRACER_DEVICE_MOVING_H
#include "wavetracer/device/bvh.h"

// The head says where the parts begin, counted in float4. The top-level tree follows it, root first; its leaves count
// instances.
typedef struct {
  wt_uint instances;       // wt_instance, in the order of the leaves of the top-level tree
  wt_uint nodes;           // nodes of the models: wt_centred_node on GPUs, wt_bvh8_node on CPUs
  wt_uint triangles;       // triangles of the models: wt_bvh2_triangle on GPUs, wt_triangle_block on CPUs
  wt_uint triangle_slots;  // triangle slots of all models (wt_bvh2_triangle)
  wt_uint padding[4];      // vectors of eight lanes begin at even float4
} wt_moving_head;

typedef struct {
  wt_float4 row[3];  // k: row k of the rotation from scene to model axes, and component k of its position
  wt_int root;       // node of its model
  wt_uint first_surface;
  wt_uint first_primitive;
  wt_uint number;
} wt_instance;

// The part of an instance that stays the same in all frames: the box of its model, in model coordinates, and its tree.
typedef struct {
  float lower[3];
  wt_int root;
  float upper[3];
  wt_uint first_primitive;
} wt_body;

// The surface that a launched ray "leaves": an antenna's own vehicle hides nothing from it (WT_NONE: no vehicle).
#define WT_OWN 0x80000000u

// The top-level tree of n instances is at most this deep, so a stack with this many entries suffices.
#define WT_TOP_STACK 64

#endif
