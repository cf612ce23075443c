// The BVH2 layout: sixteen floats a node with both children's boxes, and triangles in three rotations of their axes.
// Assumes a tree whose leaves hold at most 15 triangles.
#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "accel/layout.hpp"
#include "wavetracer/device/bvh.h"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr uint32_t kTriangleFloats = 12;

float bits(int32_t integer) { return std::bit_cast<float>(integer); }
float bits(uint32_t integer) { return std::bit_cast<float>(integer); }
int32_t leaf_reference(uint32_t first, uint32_t count) {
  return ~static_cast<int32_t>((first << WT_LEAF_BITS) | count);
}

void store_child(float* node, int side, const Box& box, int32_t child) {
  float* xy = node + 4 * side;
  float* z = node + 8 + 2 * side;
  xy[0] = box.lower[0];
  xy[1] = box.upper[0];
  xy[2] = box.lower[1];
  xy[3] = box.upper[1];
  z[0] = box.lower[2];
  z[1] = box.upper[2];
  node[12 + side] = bits(child);
}

class Writer {
 public:
  Writer(const BinaryTree& tree, Bvh2& out) : tree_(tree), out_(out) {}

  // Writes a binary inner node and all below, in depth-first order.
  int32_t inner(const BinaryNode& node, uint32_t depth) {
    const size_t at = append(depth);
    const BinaryNode &left = tree_.nodes[node.left], &right = tree_.nodes[node.right];
    const int32_t left_child = child(left, depth + 1), right_child = child(right, depth + 1);
    store_child(&out_.nodes[at], 0, left.box, left_child);
    store_child(&out_.nodes[at], 1, right.box, right_child);
    return static_cast<int32_t>(at / WT_BVH2_NODE_FLOATS);
  }

  // A root above one leaf, or above nothing.
  void lonely_root() {
    const size_t at = append(1);
    const bool leaf = !tree_.nodes.empty();
    store_child(&out_.nodes[at], 0, leaf ? tree_.nodes[0].box : Box{},
                leaf ? child(tree_.nodes[0], 1) : leaf_reference(0, 0));
    store_child(&out_.nodes[at], 1, Box{}, leaf_reference(0, 0));
  }

 private:
  const BinaryTree& tree_;
  Bvh2& out_;

  size_t append(uint32_t depth) {
    const size_t at = out_.nodes.size();
    out_.nodes.resize(at + WT_BVH2_NODE_FLOATS, 0.0f);
    out_.max_depth = std::max(out_.max_depth, depth);
    return at;
  }
  int32_t child(const BinaryNode& node, uint32_t depth) {
    if (node.left != 0) return inner(node, depth);
    if (node.count >= 1u << WT_LEAF_BITS) {
      throw RuntimeError("a leaf of " + std::to_string(node.count) +
                         " triangles does not fit a BVH2; build with max_leaf of " +
                         std::to_string((1u << WT_LEAF_BITS) - 1) + " or less");
    }
    return leaf_reference(node.first, node.count);
  }
};

}  // namespace

Bvh2 make_bvh2(const BinaryTree& tree, std::span<const AccelTriangle> triangles) {
  Bvh2 out;
  Writer writer(tree, out);
  if (!tree.nodes.empty() && tree.nodes[0].left != 0) {
    out.nodes.reserve(tree.nodes.size() / 2 * WT_BVH2_NODE_FLOATS);
    writer.inner(tree.nodes[0], 1);
  } else {
    writer.lonely_root();
  }

  const size_t slots = tree.references.size();
  out.triangle_slots = static_cast<uint32_t>(slots);
  out.triangles.resize(3 * slots * kTriangleFloats, 0.0f);
  tbb::parallel_for(size_t{0}, slots, [&](size_t slot) {
    const AccelTriangle& triangle = triangles[tree.references[slot]];
    for (size_t kz = 0; kz < 3; kz++) {
      float* to = &out.triangles[(kz * slots + slot) * kTriangleFloats];
      for (size_t vertex = 0; vertex < 3; vertex++)
        for (size_t axis = 0; axis < 3; axis++) to[4 * vertex + axis] = triangle.v[vertex][(kz + 1 + axis) % 3];
      to[3] = bits(triangle.primitive);
      to[7] = bits(triangle.surface);
    }
  });
  return out;
}

// Pairs (minimum, maximum) to (centre, half size). The half size is padded by 16 units in the last place of the largest
// distance: the slab test rounds four times, the sheared vertices of the triangle test three times, each by at most one
// unit of a coordinate or of a distance of twice that size.
std::vector<float> centred_boxes(std::vector<float> nodes, float extent_m) {
  const double padding = 16.0 * 6e-8 * 2.0 * static_cast<double>(extent_m);
  for (size_t node = 0; node < nodes.size(); node += WT_BVH2_NODE_FLOATS)
    for (size_t pair = node; pair < node + 12; pair += 2) {
      const double lower = static_cast<double>(nodes[pair]), upper = static_cast<double>(nodes[pair + 1]);
      const bool unused = !(lower <= upper);
      const float centre = unused ? 0.0f : static_cast<float>(0.5 * (lower + upper));
      nodes[pair] = centre;
      nodes[pair + 1] = unused ? -1.0f - static_cast<float>(padding)
                               : std::nextafter(static_cast<float>(std::max(upper - static_cast<double>(centre),
                                                                            static_cast<double>(centre) - lower) +
                                                                   padding),
                                                std::numeric_limits<float>::infinity());
    }
  return nodes;
}

}  // namespace wavetracer
