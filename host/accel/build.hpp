// The builder of binary bounding volume hierarchies: binned surface area heuristic (SAH) with optional spatial splits.
// Assumes finite float32 triangles; runs on all cores, and its result does not depend on how many there are.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "accel/box.hpp"
#include "accel/triangles.hpp"

namespace wavetracer {

struct BuildOptions {
  // Split large triangles between children (Stich, Friedrich, Dietrich: Spatial Splits in Bounding Volume Hierarchies,
  // HPG 2009). They help where large triangles lie askew and cost time elsewhere, whatever the SAH predicts: off until
  // a caller has timed both.
  bool spatial_splits = false;
  // Triangles a leaf may hold. Four fill one block of a BVH8 and keep a BVH2's leaves short.
  uint32_t max_leaf = 4;
  // Triangles that the tracer tests at once: 1 in a BVH2, 4 in a BVH8. A leaf costs its number of such tests.
  uint32_t block = 1;
  // The SAH's cost of testing one node's boxes, where one test of triangles costs 1. The choice matters little: CPU
  // tracing of a city changed by about 5 % between 0.5 and 2, and 0.5 was the fastest.
  float node_cost = 0.5f;
  // Spatial splits may add this many references for each triangle. With more than 1 the SAH cost of a city falls by
  // less than 2 %, for a tree up to twice as large.
  float duplication = 1;
  // A spatial split is tried where the children of the best object split overlap by more than this part of the root's
  // area (alpha of Stich et al., who found 1e-5 to give most of the gain).
  float overlap = 1e-5f;
  // No leaf lies deeper, so kernels can size their stacks; levels that are left are spent on halving by count once they
  // would not suffice otherwise. A city of 40,000 triangles needs 24.
  uint32_t max_depth = 60;

  // What suits each layout. make_bvh8 chooses leaves itself, so it wants a tree down to single triangles.
  static BuildOptions for_bvh2() { return {}; }
  static BuildOptions for_bvh8() {
    BuildOptions options;
    options.max_leaf = 1;
    options.block = 4;
    return options;
  }
};

// An inner node has two children; a leaf has count > 0 and left = right = 0.
struct BinaryNode {
  Box box;
  uint32_t left = 0, right = 0;   // indices into BinaryTree::nodes
  uint32_t first = 0, count = 0;  // into BinaryTree::references; of inner nodes too: all references below
};

// Nodes in depth-first order, left children next to their parents, node 0 the root; no node at all without triangles.
struct BinaryTree {
  std::vector<BinaryNode> nodes;
  std::vector<uint32_t>
      references;          // indices into the triangles; with spatial splits a triangle may be in several leaves
  uint32_t max_depth = 0;  // of the deepest leaf, where the root's is 0
};

// Every triangle is in at least one leaf. Without spatial splits boxes are the exact bounds of their triangles; with
// them, clipped boxes are rounded outwards, and the leaves that hold a triangle cover it. Throws RuntimeError where
// options cannot be met (see check in build.cpp) or there are more triangles than indices.
BinaryTree build_binary(std::span<const AccelTriangle> triangles, const BuildOptions& options);

// Expected cost of a ray that meets the root's box, in tests of triangles: node_cost for every inner node and one for
// each started block of a leaf, weighted with the boxes' areas.
double sah_cost(const BinaryTree& tree, const BuildOptions& options);

}  // namespace wavetracer
