// SPDX-License-Identifier: Apache-2.0
// The structural checks of the oracle: every node and triangle is met, boxes hold what is below them, limits are kept.
// Assumes that a triangle's primitive is its position in the array.
#include <bit>
#include <cstring>
#include <functional>
#include <map>

#include "oracle.hpp"
#include "wavetracer/device/bvh.h"

namespace wavetracer::test {
namespace {

Box bounds(const AccelTriangle& triangle) {
  Box box;
  for (const auto& vertex : triangle.v) box.grow(vertex);
  return box;
}

class Faults {
 public:
  void check(bool right, const std::string& what) {
    if (!right && found.size() < 10) found.push_back(what);
  }
  // Uncut triangles must lie inside their leaf's box; the leaves' boxes of a cut triangle must together contain its
  // bounds.
  void meet(uint32_t primitive, std::span<const AccelTriangle> triangles, const Box& leaf, bool exact) {
    check(primitive < triangles.size(), "no such triangle: " + std::to_string(primitive));
    if (primitive >= triangles.size()) return;
    if (exact) {
      check(leaf.contains(bounds(triangles[primitive])),
            "the leaf's box does not hold triangle " + std::to_string(primitive));
      check(!met.contains(primitive), "met twice: triangle " + std::to_string(primitive));
    }
    met[primitive].grow(leaf);
  }
  void all_met(std::span<const AccelTriangle> triangles) {
    for (uint32_t i = 0; i < triangles.size(); i++) {
      check(met.contains(i), "never met: triangle " + std::to_string(i));
      if (met.contains(i))
        check(met[i].contains(bounds(triangles[i])), "parts are missing of triangle " + std::to_string(i));
    }
  }
  std::vector<std::string> found;
  std::map<uint32_t, Box> met;
};

void check_vertices(Faults& faults, uint32_t primitive, std::span<const AccelTriangle> triangles,
                    const float (&v)[3][3], uint32_t surface) {
  if (primitive >= triangles.size()) return;
  faults.check(std::memcmp(v, triangles[primitive].v, sizeof v) == 0,
               "wrong vertices: triangle " + std::to_string(primitive));
  faults.check(surface == triangles[primitive].surface, "wrong surface: triangle " + std::to_string(primitive));
}

}  // namespace

std::vector<std::string> faults(const BinaryTree& tree, std::span<const AccelTriangle> triangles,
                                const BuildOptions& options) {
  Faults faults;
  size_t nodes = 0;
  uint32_t deepest = 0, next = 0;
  const std::function<void(uint32_t, uint32_t)> walk = [&](uint32_t index, uint32_t depth) {
    const BinaryNode& node = tree.nodes.at(index);
    faults.check(index == nodes++, "not in depth-first order: node " + std::to_string(index));
    faults.check(node.first == next, "references are not consecutive at node " + std::to_string(index));
    if (node.left != 0) {
      for (const uint32_t child : {node.left, node.right}) {
        faults.check(node.box.contains(tree.nodes.at(child).box),
                     "box larger than its parent's: node " + std::to_string(child));
        walk(child, depth + 1);
      }
      faults.check(node.first + node.count == next, "wrong count: node " + std::to_string(index));
      return;
    }
    deepest = std::max(deepest, depth);
    next += node.count;
    faults.check(node.count > 0 && node.count <= options.max_leaf,
                 "leaf of " + std::to_string(node.count) + " triangles");
    for (uint32_t i = node.first; i < node.first + node.count; i++)
      faults.meet(tree.references.at(i), triangles, node.box, !options.spatial_splits);
  };
  if (!tree.nodes.empty()) walk(0, 0);
  faults.check(nodes == tree.nodes.size(), "nodes that nothing refers to");
  faults.check(next == tree.references.size(), "references in no leaf");
  faults.check(deepest == tree.max_depth && deepest <= options.max_depth, "wrong depth: " + std::to_string(deepest));
  faults.all_met(triangles);
  return faults.found;
}

std::vector<std::string> faults(const Bvh2& bvh, std::span<const AccelTriangle> triangles, bool exact) {
  Faults faults;
  size_t nodes = 0, slots = 0;
  uint32_t deepest = 0;
  const auto leaf = [&](uint32_t reference, const Box& box) {
    const uint32_t first = reference >> WT_LEAF_BITS, count = reference & ((1u << WT_LEAF_BITS) - 1);
    slots += count;
    for (uint32_t slot = first; slot < first + count; slot++) {
      for (size_t kz = 0; kz < 3; kz++) {
        const wt_bvh2_triangle& t = bvh.triangles.at(kz * bvh.triangle_slots + slot);
        const wt_float4* const corners[3] = {&t.a, &t.b, &t.c};
        float v[3][3];
        for (size_t vertex = 0; vertex < 3; vertex++) {
          v[vertex][(kz + 1) % 3] = corners[vertex]->s[0];
          v[vertex][(kz + 2) % 3] = corners[vertex]->s[1];
          v[vertex][kz] = corners[vertex]->s[2];
        }
        const auto primitive = std::bit_cast<uint32_t>(t.a.s[3]);
        check_vertices(faults, primitive, triangles, v, std::bit_cast<uint32_t>(t.b.s[3]));
        faults.check(t.c.s[3] == 0, "the last float of a triangle is not zero");
        if (kz == 0) faults.meet(primitive, triangles, box, exact);
      }
    }
  };
  const std::function<void(int32_t, uint32_t, const Box&)> walk = [&](int32_t index, uint32_t depth,
                                                                      const Box& parent) {
    faults.check(static_cast<size_t>(index) == nodes++, "not in depth-first order: node " + std::to_string(index));
    deepest = std::max(deepest, depth);
    const wt_bvh2_node& n = bvh.nodes.at(static_cast<size_t>(index));
    for (int side = 0; side < 2; side++) {
      const wt_planes_xy& xy = side == 0 ? n.left : n.right;
      const float(&z)[2] = side == 0 ? n.left_z : n.right_z;
      const Box box{{xy.x[0], xy.y[0], z[0]}, {xy.x[1], xy.y[1], z[1]}};
      faults.check(box.empty() || parent.contains(box),
                   "box larger than its parent's at node " + std::to_string(index));
      const int32_t child = n.child[side];
      faults.check(!box.empty() || child == ~0, "an unused child is not the leaf of nothing");
      if (child >= 0) {
        walk(child, depth + 1, box);
      } else {
        leaf(static_cast<uint32_t>(~child), box);
      }
    }
  };
  Box everything;
  for (int axis = 0; axis < 3; axis++) std::swap(everything.lower[axis], everything.upper[axis]);
  walk(0, 1, everything);
  faults.check(nodes == bvh.nodes.size(), "nodes that nothing refers to");
  faults.check(slots == bvh.triangle_slots && bvh.triangles.size() == 3 * slots, "triangles in no leaf");
  faults.check(deepest == bvh.max_depth, "wrong depth: " + std::to_string(deepest));
  faults.all_met(triangles);
  return faults.found;
}

std::vector<std::string> faults(const Bvh8& bvh, std::span<const AccelTriangle> triangles, bool exact) {
  Faults faults;
  size_t nodes = 0, blocks = 0;
  uint32_t deepest = 0;
  const auto leaf = [&](uint32_t reference, const Box& box) {
    const uint32_t first = reference >> WT_LEAF_BITS, count = reference & ((1u << WT_LEAF_BITS) - 1);
    blocks += count;
    faults.check(count > 0, "leaf of no block");
    for (uint32_t k = first; k < first + count; k++) {
      const wt_triangle_block& block = bvh.blocks.at(k);
      for (size_t lane = 0; lane < 4; lane++) {
        float v[3][3];
        for (size_t row = 0; row < 9; row++) v[row / 3][row % 3] = block.corner[row].s[lane];
        const uint32_t primitive = block.primitive.s[lane];
        check_vertices(faults, primitive, triangles, v, block.surface.s[lane]);
        faults.check(block.padding.s[lane] == 0, "the last row of a block is not zero");
        const bool padding = lane > 0 && primitive == block.primitive.s[0];
        if (!padding) faults.meet(primitive, triangles, box, exact);
      }
    }
  };
  const std::function<void(int32_t, uint32_t, const Box&)> walk = [&](int32_t index, uint32_t depth,
                                                                      const Box& parent) {
    faults.check(static_cast<size_t>(index) == nodes++, "not in depth-first order: node " + std::to_string(index));
    deepest = std::max(deepest, depth);
    for (int lane = 0; lane < 8; lane++) {
      const wt_bvh8_node& n = bvh.nodes.at(static_cast<size_t>(index));
      const auto plane = [&](int row) { return n.planes[row].s[lane]; };
      const Box box{{plane(0), plane(1), plane(2)}, {plane(3), plane(4), plane(5)}};
      const int32_t child = n.child[lane];
      faults.check(n.padding[lane] == 0, "the last row of a node is not zero");
      faults.check(child != 0, "the root is a child of node " + std::to_string(index));
      if (child == ~0) {
        faults.check(box.empty(), "an unused child has a box");
        continue;
      }
      faults.check(!box.empty() && parent.contains(box),
                   "box larger than its parent's at node " + std::to_string(index));
      if (child > 0) {
        walk(child, depth + 1, box);
      } else {
        leaf(static_cast<uint32_t>(~child), box);
      }
    }
  };
  Box everything;
  for (int axis = 0; axis < 3; axis++) std::swap(everything.lower[axis], everything.upper[axis]);
  walk(0, 1, everything);
  faults.check(nodes == bvh.nodes.size(), "nodes that nothing refers to");
  faults.check(blocks == bvh.blocks.size(), "blocks in no leaf");
  faults.check(deepest == bvh.max_depth, "wrong depth: " + std::to_string(deepest));
  faults.all_met(triangles);
  return faults.found;
}

}  // namespace wavetracer::test
