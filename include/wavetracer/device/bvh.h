// Layouts of the acceleration structures, one definition for C++ (host/accel) and OpenCL C (kernels/lib).
// Everything is float32 around the scene's origin. A child reference c >= 0 is an inner node's index; c < 0 is a leaf:
// ~c packs (first << WT_LEAF_BITS) | count. An unused child has an inverted box (lower > upper) and is a leaf of
// nothing, so that a ray whose slabs overflow, which meets every box, still enters each node once.
#ifndef WAVETRACER_DEVICE_BVH_H
#define WAVETRACER_DEVICE_BVH_H

#define WT_LEAF_BITS 4

// BVH2 (GPUs, ray packets on CPUs): 64 bytes a node, as 16 floats
//   0 left.min.x   1 left.max.x   2 left.min.y   3 left.max.y
//   4 right.min.x  5 right.max.x  6 right.min.y  7 right.max.y
//   8 left.min.z   9 left.max.z  10 right.min.z 11 right.max.z
//  12 left child  13 right child (int)  14, 15 zero
// Packets read it so. For one ray a work-item the upload (host/passes/device_scene.cpp) turns each pair (min, max) into
// (centre, half size), padded for rounding; there, an unused child has half size -1.
// Its leaves count triangles; a triangle is three float4 (v0.xyz, primitive) (v1.xyz, surface) (v2.xyz, 0), integers as
// bits, stored three times, with coordinates rotated so that axis kz comes last: copy kz holds (v[(kz+1)%3],
// v[(kz+2)%3], v[kz]). Copy kz starts at float4 index kz * 3 * triangle_slots.
#define WT_BVH2_NODE_FLOATS 16

// BVH8 (CPUs): 256 bytes a node, as 64 floats: min.x[8] min.y[8] min.z[8] max.x[8] max.y[8] max.z[8] child[8] (int)
// zero[8]. Its leaves count blocks of four triangles, 48 floats a block: nine rows of four, row 3 * vertex + axis, then
// primitive[4], surface[4] (uint), zero[4]. Incomplete blocks repeat their first triangle (never zeros).
#define WT_BVH8_NODE_FLOATS 64
#define WT_BLOCK_FLOATS 48

#endif
