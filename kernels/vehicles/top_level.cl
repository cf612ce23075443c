// SPDX-License-Identifier: Apache-2.0
// top_level: the top-level tree of a frame (wavetracer/device/moving.h), over instances in the order of keys that are
// sorted between the first kernel and the others. It is numbered as a heap: below node k are 2 k + 1 and 2 k + 2, so
// every level is a range of numbers, and so are the leaves. A box is two float4, the lower and the upper corner.
#include "wavetracer/device/curves.h"
#include "wavetracer/device/moving.h"
#include "wavetracer/device/records.h"
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#pragma OPENCL FP_CONTRACT OFF

// The cell of a coordinate among 2^WT_KEY_LEVEL over the scene's width.
inline uint cell(float x, float extent_m) {
  const float cells = (float)(1 << WT_KEY_LEVEL);
  return (uint)clamp((0.5f + 0.5f * x / extent_m) * cells, 0.0f, cells - 1.0f);
}

// Computes the box of every instance in scene coordinates, rounded outwards, and its key: vehicles stand side by side,
// so their places on the ground order them. Absent instances get the largest keys.
kernel void instance_keys(const global wt_exact_instance* instances, const global wt_body* bodies, uint instance_count,
                          float extent_m, global float4* boxes, global uint* keys) {
  const uint i = get_global_id(0);
  if (i >= instance_count) return;
  const global wt_exact_instance* instance = instances + i;
  const double3 a = convert_double3(vload3(0, bodies[i].lower)), b = convert_double3(vload3(0, bodies[i].upper));
  const double3 c = 0.5 * (a + b), h = 0.5 * (b - a);
  float lower[3], upper[3];
  for (int axis = 0; axis < 3; ++axis) {
    const global double* row = instance->rotation + 3 * axis;
    const double centre = instance->position[axis] + row[0] * c.x + row[1] * c.y + row[2] * c.z;
    const double half_size = fabs(row[0]) * h.x + fabs(row[1]) * h.y + fabs(row[2]) * h.z;
    lower[axis] = nextafter((float)(centre - half_size), -INFINITY);
    upper[axis] = nextafter((float)(centre + half_size), INFINITY);
  }
  boxes[2 * i] = (float4)(lower[0], lower[1], lower[2], 0.0f);
  boxes[2 * i + 1] = (float4)(upper[0], upper[1], upper[2], 0.0f);
  const uint x = cell(0.5f * (lower[0] + upper[0]), extent_m), y = cell(0.5f * (lower[1] + upper[1]), extent_m);
  keys[i] = instance->present ? wt_hilbert2_encode32(x, y, WT_KEY_LEVEL) : 1u << (2 * WT_KEY_LEVEL);
}

inline uint bit_floor(uint x) { return 1u << (31 - clz(x)); }

// Returns the place in the order of the leaf that has number k in a heap of leaf_count leaves. Leaves of the lowest
// level, which begins at `lowest`, come first, and the rest, one level up, follow them.
inline uint place_of_leaf(uint k, uint lowest, uint leaf_count) {
  return k < lowest ? k + leaf_count - lowest : k - lowest;
}

// Writes instances in the order of their leaves, and the boxes of the leaves. There are at least two leaves; from
// `present` on they are empty: their boxes are inverted.
kernel void leaves(const global uint* order, const global wt_exact_instance* instances, const global wt_body* bodies,
                   const global float4* boxes, uint present, uint leaf_count, global float4* tree,
                   global float4* moving) {
  const uint k = leaf_count - 1 + get_global_id(0);
  if (get_global_id(0) >= leaf_count) return;
  const uint place = place_of_leaf(k, bit_floor(2 * leaf_count - 1) - 1, leaf_count);
  if (place >= present) {
    tree[2 * k] = (float4)(INFINITY);
    tree[2 * k + 1] = (float4)(-INFINITY);
    return;
  }
  const uint number = order[place];
  tree[2 * k] = boxes[2 * number];
  tree[2 * k + 1] = boxes[2 * number + 1];
  const global wt_exact_instance* instance = instances + number;
  const global wt_moving_head* head = (const global wt_moving_head*)moving;
  global wt_instance* record = (global wt_instance*)(moving + head->instances) + place;
  for (int row = 0; row < 3; ++row)
    record->row[row] = (float4)((float)instance->rotation[row], (float)instance->rotation[3 + row],
                                (float)instance->rotation[6 + row], (float)instance->position[row]);
  record->root = bodies[number].root;
  record->first_surface = instance->first_surface;
  record->first_primitive = bodies[number].first_primitive;
  record->number = number;
}

// Computes the boxes of the inner nodes except the root, one level after the other, by one group.
__attribute__((reqd_work_group_size(WT_ITEMS, 1, 1))) kernel void inner_boxes(uint leaf_count, global float4* tree) {
  for (uint first = bit_floor(leaf_count - 1) - 1; first > 0; first /= 2) {
    const uint end = min(2 * first + 1, leaf_count - 1);
    for (uint k = first + get_local_id(0); k < end; k += WT_ITEMS) {
      const global float4 *left = tree + 2 * (2 * k + 1), *right = left + 2;
      tree[2 * k] = fmin(left[0], right[0]);
      tree[2 * k + 1] = fmax(left[1], right[1]);
    }
    barrier(CLK_GLOBAL_MEM_FENCE);
  }
}

// An interval as centre and half size: centred_nodes of host/accel/layout.hpp, bit for bit.
inline float2 centred(float lower, float upper, double padding) {
  if (!(lower <= upper)) return (float2)(0.0f, -1.0f - (float)padding);
  const float centre = (float)(0.5 * ((double)lower + (double)upper));
  const double half_size = fmax((double)upper - (double)centre, (double)centre - (double)lower) + padding;
  return (float2)(centre, nextafter((float)half_size, INFINITY));
}

// Writes the inner nodes as traversal reads them.
kernel void top_nodes(const global float4* tree, uint present, uint leaf_count, float extent_m, global float4* moving) {
  const uint k = get_global_id(0);
  if (k >= leaf_count - 1) return;
  const uint lowest = bit_floor(2 * leaf_count - 1) - 1;
  const double padding = 16.0 * 6e-8 * 2.0 * (double)extent_m;
  float2 x[2], y[2], z[2];
  int reference[2];
  for (uint side = 0; side < 2; ++side) {
    const uint child = 2 * k + 1 + side;
    const float4 lower = tree[2 * child], upper = tree[2 * child + 1];
    x[side] = centred(lower.x, upper.x, padding);
    y[side] = centred(lower.y, upper.y, padding);
    z[side] = centred(lower.z, upper.z, padding);
    const uint place = place_of_leaf(child, lowest, leaf_count);
    reference[side] = child < leaf_count - 1 ? (int)child : wt_leaf(place, place < present);
  }
  global wt_centred_node* node = (global wt_centred_node*)((global wt_moving_head*)moving + 1) + k;
  node->left = (float4)(x[0], y[0]);
  node->right = (float4)(x[1], y[1]);
  node->z = (float4)(z[0], z[1]);
  node->child = (int4)(reference[0], reference[1], 0, 0);
}
