// SPDX-License-Identifier: Apache-2.0
// The layouts that kernels traverse, made from a binary tree: BVH2 for GPUs and packets, BVH8 for CPUs.
// wavetracer/device/bvh.h defines their memory; node 0 is always an inner node, even in an empty scene.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "accel/box.hpp"
#include "accel/build.hpp"
#include "wavetracer/device/bvh.h"

namespace wavetracer {

struct Bvh2 {
  std::vector<wt_bvh2_node> nodes;
  std::vector<wt_bvh2_triangle> triangles;  // three rotated copies of triangle_slots triangles
  uint32_t triangle_slots = 0;
  // Number of inner nodes on the longest path from the root, root included: a stack of this many entries suffices.
  uint32_t max_depth = 0;
};

// An unused child (in a tree with fewer than two leaves) has an inverted box and is a leaf of no triangles: kernels
// that sort a box's planes may enter it and find nothing. Throws RuntimeError for a leaf of more triangles than a
// reference can count; build with max_leaf <= 15.
Bvh2 make_bvh2(const BinaryTree& tree, std::span<const AccelTriangle> triangles);

// Returns BVH2 nodes in the form for one ray per work-item: boxes as centre and half size, padded for the rounding of
// rays whose origins and hits have coordinates of at most extent_m.
std::vector<wt_centred_node> centred_nodes(std::span<const wt_bvh2_node> nodes, float extent_m);

struct Bvh8 {
  std::vector<wt_bvh8_node> nodes;
  std::vector<wt_triangle_block> blocks;
  // Number of inner nodes on the longest path from the root, root included: a stack of 7 * max_depth + 1 entries
  // suffices.
  uint32_t max_depth = 0;
};

// Collapses the binary tree into the eight-wide tree of least SAH cost, leaves included (Ylitie, Karras, Laine:
// Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs, HPG 2017, section 3.1).
struct CollapseOptions {
  // Cost of testing eight boxes, relative to a block of four triangles; as in BuildOptions.
  float node_cost = 0.5f;
  // Largest number of triangles in a leaf; 4 is one block. More blocks per leaf mean fewer nodes, but more tests of
  // triangles without a hit.
  uint32_t max_leaf = 4;
};
Bvh8 make_bvh8(const BinaryTree& tree, std::span<const AccelTriangle> triangles, const CollapseOptions& options = {});

// Fills a node of a BVH2, for the builders of trees over triangles and over instances.

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
