// SPDX-License-Identifier: Apache-2.0
// Fills a node of a BVH2, for the builders of trees over triangles and over instances.
#pragma once
#include "accel/box.hpp"
#include "wavetracer/device/bvh.h"

namespace wavetracer {

// side: 0 left, 1 right. child: an inner node's index or wt_leaf().
inline void store_child(wt_bvh2_node& node, int side, const Box& box, int32_t child) {
  wt_planes_xy& xy = side == 0 ? node.left : node.right;
  float(&z)[2] = side == 0 ? node.left_z : node.right_z;
  for (int upper = 0; upper < 2; ++upper) {
    const float(&corner)[3] = upper ? box.upper : box.lower;
    xy.x[upper] = corner[0];
    xy.y[upper] = corner[1];
    z[upper] = corner[2];
  }
  node.child[side] = child;
}

// Makes a root over one box, which is the leaf `child`, or over nothing: then box is empty and child is wt_leaf(0, 0).
inline wt_bvh2_node lonely_root(const Box& box, int32_t child) {
  wt_bvh2_node node{};
  store_child(node, 0, box, child);
  store_child(node, 1, Box{}, wt_leaf(0, 0));
  return node;
}

}  // namespace wavetracer
