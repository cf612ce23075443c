// SPDX-License-Identifier: Apache-2.0
// Builds binary bounding volume hierarchies by the binned surface area heuristic (SAH), with optional spatial splits.
// Triangles must be finite in float32. It runs on all cores, and the result does not depend on their number.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "accel/box.hpp"
#include "accel/triangles.hpp"

namespace wavetracer {

struct BuildOptions {
  // Split large triangles between children (Stich, Friedrich, Dietrich: Spatial Splits in Bounding Volume Hierarchies,
  // HPG 2009). They help where large triangles are not parallel to the axes and cost time elsewhere, even if the SAH
  // predicts a gain. They are off unless a caller has timed both.
  bool spatial_splits = false;
  // Largest number of triangles in a leaf. Four fill one block of a BVH8 and keep a BVH2's leaves short.
  uint32_t max_leaf = 4;
  // Number of triangles that the tracer tests at once: 1 in a BVH2, 4 in a BVH8. The cost of a leaf is its number of
  // such tests.
  uint32_t block = 1;
  // Cost in the SAH of testing one node's boxes, relative to one test of triangles. The choice matters little: CPU
  // tracing of a city changed by about 5 % between 0.5 and 2, and 0.5 was the fastest.
  float node_cost = 0.5f;
  // Number of references that spatial splits may add per triangle. With more than 1 the SAH cost of a city falls by
  // less than 2 %, for a tree up to twice as large.
  float duplication = 1;
  // A spatial split is tried if the children of the best object split overlap by more than this share of the root's
  // area (alpha of Stich et al., who found that 1e-5 gives most of the gain).
  float overlap = 1e-5f;
  // The largest depth of a leaf, so that kernels can size their stacks. Once the remaining levels would not suffice
  // otherwise, nodes are halved by count. A city of 40,000 triangles needs 24 levels.
  uint32_t max_depth = 60;

  // These options suit each layout. make_bvh8 chooses leaves itself, so it needs a tree down to single triangles.
  static BuildOptions for_bvh2() { return {}; }
  static BuildOptions for_bvh8() {
    BuildOptions options;
    options.max_leaf = 1;
    options.block = 4;
    return options;
  }
};

// A node: an inner node has two children; a leaf has count > 0 and left = right = 0.
struct BinaryNode {
  Box box;
  uint32_t left = 0, right = 0;   // indices into BinaryTree::nodes
  uint32_t first = 0, count = 0;  // range in BinaryTree::references; for inner nodes too: all references below
};

// Nodes in depth-first order, left children next to their parents, with the root as node 0; there is no node without
// triangles.
struct BinaryTree {
  std::vector<BinaryNode> nodes;
  std::vector<uint32_t>
      references;          // indices into the triangles; with spatial splits a triangle may be in several leaves
  uint32_t max_depth = 0;  // depth of the deepest leaf; the root's is 0
};

// Every triangle is in at least one leaf. Without spatial splits boxes are the exact bounds of their triangles; with
// them, clipped boxes are rounded outwards, and the leaves that hold a triangle cover it. Throws RuntimeError if
// options cannot be met (see check in build.cpp) or there are more triangles than indices.
BinaryTree build_binary(std::span<const AccelTriangle> triangles, const BuildOptions& options);

// Returns the expected cost of a ray that meets the root's box, in tests of triangles: node_cost for every inner node
// and one for each started block of a leaf, weighted with the boxes' areas.
double sah_cost(const BinaryTree& tree, const BuildOptions& options);

}  // namespace wavetracer
