// Layout of what moves, one definition for C++ (host/passes/place.cpp, kernels/top_level.cl) and OpenCL C
// (kernels/lib/moving*.clh): one buffer of float4 with a head, the top-level tree of the frame, its instances, and the
// trees of all models. Two-level traversal: the top level in scene coordinates, then the ray in the coordinates of a
// model.
#ifndef WAVETRACER_DEVICE_MOVING_H
#define WAVETRACER_DEVICE_MOVING_H

// The head, as unsigned words: places of the parts, counted in float4.
#define WT_MOVING_INSTANCES 0       // WT_INSTANCE_FLOAT4S each, in the order of the leaves of the top-level tree
#define WT_MOVING_NODES 1           // of the models: BVH2 nodes, centred, on GPUs; BVH8 nodes on CPUs
#define WT_MOVING_TRIANGLES 2       // of the models: triangles of the BVH2 on GPUs; blocks of the BVH8 on CPUs
#define WT_MOVING_TRIANGLE_SLOTS 3  // of all models (BVH2)
// The top-level tree, BVH2 nodes in the centred layout of bvh.h, root first; a leaf counts instances.
#define WT_MOVING_TOP 2

// An instance: row k of the rotation from scene to model axes, and component k of its position, for k = 0, 1, 2; then
// the root node of its model, its first surface, its first primitive and its number, as unsigned words.
#define WT_INSTANCE_FLOAT4S 4

// The surface that a launch ray "leaves": the antenna's own vehicle hides nothing from it (WT_NONE: no vehicle).
#define WT_OWN 0x80000000u

// The top-level tree of n instances is at most this deep, so a stack of as many entries suffices.
#define WT_TOP_STACK 64

#endif
