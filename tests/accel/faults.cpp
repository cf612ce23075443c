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
  // Uncut triangles lie inside their leaf's box; of cut ones, the leaves' boxes together hold the bounds.
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
        const float* t = &bvh.triangles.at(12 * (kz * bvh.triangle_slots + slot));
        float v[3][3];
        for (size_t vertex = 0; vertex < 3; vertex++) {
          v[vertex][(kz + 1) % 3] = t[4 * vertex];
          v[vertex][(kz + 2) % 3] = t[4 * vertex + 1];
          v[vertex][kz] = t[4 * vertex + 2];
        }
        const auto primitive = std::bit_cast<uint32_t>(t[3]);
        check_vertices(faults, primitive, triangles, v, std::bit_cast<uint32_t>(t[7]));
        faults.check(t[11] == 0, "the last float of a triangle is not zero");
        if (kz == 0) faults.meet(primitive, triangles, box, exact);
      }
    }
  };
  const std::function<void(int32_t, uint32_t, const Box&)> walk = [&](int32_t index, uint32_t depth,
                                                                      const Box& parent) {
    faults.check(static_cast<size_t>(index) == nodes++, "not in depth-first order: node " + std::to_string(index));
    deepest = std::max(deepest, depth);
    const float* n = &bvh.nodes.at(static_cast<size_t>(index) * WT_BVH2_NODE_FLOATS);
    for (int side = 0; side < 2; side++) {
      const float *xy = n + 4 * side, *z = n + 8 + 2 * side;
      const Box box{{xy[0], xy[2], z[0]}, {xy[1], xy[3], z[1]}};
      faults.check(box.empty() || parent.contains(box),
                   "box larger than its parent's at node " + std::to_string(index));
      const auto child = std::bit_cast<int32_t>(n[12 + side]);
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
  faults.check(nodes * WT_BVH2_NODE_FLOATS == bvh.nodes.size(), "nodes that nothing refers to");
  faults.check(slots == bvh.triangle_slots && bvh.triangles.size() == 36 * slots, "triangles in no leaf");
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
      const float* block = &bvh.blocks.at(static_cast<size_t>(k) * WT_BLOCK_FLOATS);
      for (size_t lane = 0; lane < 4; lane++) {
        float v[3][3];
        for (size_t row = 0; row < 9; row++) v[row / 3][row % 3] = block[4 * row + lane];
        const auto primitive = std::bit_cast<uint32_t>(block[36 + lane]);
        check_vertices(faults, primitive, triangles, v, std::bit_cast<uint32_t>(block[40 + lane]));
        faults.check(block[44 + lane] == 0, "the last row of a block is not zero");
        const bool padding = lane > 0 && primitive == std::bit_cast<uint32_t>(block[36]);
        if (!padding) faults.meet(primitive, triangles, box, exact);
      }
    }
  };
  const std::function<void(int32_t, uint32_t, const Box&)> walk = [&](int32_t index, uint32_t depth,
                                                                      const Box& parent) {
    faults.check(static_cast<size_t>(index) == nodes++, "not in depth-first order: node " + std::to_string(index));
    deepest = std::max(deepest, depth);
    for (int lane = 0; lane < 8; lane++) {
      const float* p = &bvh.nodes.at(static_cast<size_t>(index) * WT_BVH8_NODE_FLOATS) + lane;
      const Box box{{p[0], p[8], p[16]}, {p[24], p[32], p[40]}};
      const auto child = std::bit_cast<int32_t>(p[48]);
      faults.check(p[56] == 0, "the last row of a node is not zero");
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
  faults.check(nodes * WT_BVH8_NODE_FLOATS == bvh.nodes.size(), "nodes that nothing refers to");
  faults.check(blocks * WT_BLOCK_FLOATS == bvh.blocks.size(), "blocks in no leaf");
  faults.check(deepest == bvh.max_depth, "wrong depth: " + std::to_string(deepest));
  faults.all_met(triangles);
  return faults.found;
}

}  // namespace wavetracer::test
