// SPDX-License-Identifier: Apache-2.0
// Layouts of the acceleration structures, one definition for C++ (host/accel) and OpenCL C (kernels/lib).
// Everything is float32 around the scene's origin. A child reference c >= 0 is an inner node's index; c < 0 is a leaf
// (wt_leaf). An unused child has an inverted box (lower > upper) and is a leaf without elements. A ray whose slabs
// overflow meets every box; it then still enters each node only once.
#ifndef WAVETRACER_DEVICE_BVH_H
#define WAVETRACER_DEVICE_BVH_H
#include "wavetracer/device/types.h"

#define WT_LEAF_BITS 4

// wt_leaf makes the reference of a leaf of `count` elements from `first` on; the others take it apart.
inline wt_int wt_leaf(wt_uint first, wt_uint count) { return ~(wt_int)((first << WT_LEAF_BITS) | count); }
inline wt_uint wt_leaf_first(wt_int reference) { return (wt_uint)~reference >> WT_LEAF_BITS; }
inline wt_uint wt_leaf_end(wt_int reference) {
  return wt_leaf_first(reference) + ((wt_uint)~reference & ((1u << WT_LEAF_BITS) - 1u));
}

// Lower and upper planes of a box.
typedef struct {
  float x[2];
  float y[2];
} wt_planes_xy;

// A node of a BVH2 (GPUs, ray packets on CPUs) as it is built and as packets read it. Its leaves count triangles.
typedef struct {
  wt_planes_xy left;
  wt_planes_xy right;
  float left_z[2];
  float right_z[2];
  wt_int child[2];  // left, right
  wt_uint padding[2];
} wt_bvh2_node;

// The same node for one ray per work-item: boxes as centre and half size, padded for rounding (centred_nodes of
// host/accel/layout.hpp). An unused child has half size -1.
typedef struct {
  wt_float4 left;   // centre x, half size x, centre y, half size y
  wt_float4 right;  // the same for the right child
  wt_float4 z;      // centre and half size of left, then of right
  wt_int4 child;    // left, right, 0, 0
} wt_centred_node;

// A triangle of a BVH2. It is stored three times, with coordinates rotated so that axis kz comes last: copy kz holds
// (v[(kz+1)%3], v[(kz+2)%3], v[kz]) of each vertex, and begins at triangle kz * triangle_slots.
typedef struct {
  wt_float4 a;  // the last lane: the primitive, as bits
  wt_float4 b;  // the surface, as bits
  wt_float4 c;  // 0
} wt_bvh2_triangle;

// A node of a BVH8 (CPUs). Its leaves count blocks.
typedef struct {
  wt_float8 planes[6];  // lower x, y, z, then upper x, y, z of eight children
  wt_int child[8];
  wt_uint padding[8];
} wt_bvh8_node;

// Four triangles; an incomplete block repeats its first one (it is never filled with zeros).
typedef struct {
  wt_float4 corner[9];  // 3 * vertex + axis
  wt_uint4 primitive;
  wt_uint4 surface;
  wt_uint4 padding;
} wt_triangle_block;

#endif
