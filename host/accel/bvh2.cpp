// SPDX-License-Identifier: Apache-2.0
// The BVH2 layout: nodes with the boxes of both children, and triangles in three rotations of their axes. Leaves of the
// tree must hold at most 15 triangles.
#include <tbb/parallel_for.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "accel/layout.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

float bits(uint32_t integer) { return std::bit_cast<float>(integer); }

class Writer {
 public:
  Writer(const BinaryTree& tree, Bvh2& out) : tree_(tree), out_(out) {}

  // Writes a binary inner node and all nodes below it, in depth-first order.
  int32_t inner(const BinaryNode& node, uint32_t depth) {
    const size_t at = out_.nodes.size();
    out_.nodes.push_back({});
    out_.max_depth = std::max(out_.max_depth, depth);
    const BinaryNode &left = tree_.nodes[node.left], &right = tree_.nodes[node.right];
    const int32_t left_child = child(left, depth + 1), right_child = child(right, depth + 1);
    store_child(out_.nodes[at], 0, left.box, left_child);
    store_child(out_.nodes[at], 1, right.box, right_child);
    return static_cast<int32_t>(at);
  }

  // Writes a root above a single leaf, or above nothing.
  void lonely() {
    out_.max_depth = 1;
    out_.nodes.push_back(tree_.nodes.empty() ? lonely_root(Box{}, wt_leaf(0, 0))
                                             : lonely_root(tree_.nodes[0].box, child(tree_.nodes[0], 1)));
  }

 private:
  const BinaryTree& tree_;
  Bvh2& out_;

  int32_t child(const BinaryNode& node, uint32_t depth) {
    if (node.left != 0) return inner(node, depth);
    if (node.count >= 1u << WT_LEAF_BITS) {
      throw RuntimeError("a leaf of " + std::to_string(node.count) +
                         " triangles does not fit a BVH2; build with max_leaf of " +
                         std::to_string((1u << WT_LEAF_BITS) - 1) + " or less");
    }
    return wt_leaf(node.first, node.count);
  }
};

}  // namespace

Bvh2 make_bvh2(const BinaryTree& tree, std::span<const AccelTriangle> triangles) {
  Bvh2 out;
  Writer writer(tree, out);
  if (!tree.nodes.empty() && tree.nodes[0].left != 0) {
    out.nodes.reserve(tree.nodes.size() / 2);
    writer.inner(tree.nodes[0], 1);
  } else {
    writer.lonely();
  }

  const size_t slots = tree.references.size();
  out.triangle_slots = static_cast<uint32_t>(slots);
  out.triangles.resize(3 * slots);
  tbb::parallel_for(size_t{0}, slots, [&](size_t slot) {
    const AccelTriangle& triangle = triangles[tree.references[slot]];
    for (size_t kz = 0; kz < 3; kz++) {
      const auto rotated = [&](size_t vertex, uint32_t last) {
        const auto& v = triangle.v[vertex];
        return wt_float4{v[(kz + 1) % 3], v[(kz + 2) % 3], v[kz], bits(last)};
      };
      out.triangles[kz * slots + slot] = {rotated(0, triangle.primitive), rotated(1, triangle.surface), rotated(2, 0)};
    }
  });
  return out;
}

namespace {

// An interval as centre and half size.
struct Centred {
  float centre, half_size;
};

Centred centred(const float (&planes)[2], double padding) {
  const double lower = static_cast<double>(planes[0]), upper = static_cast<double>(planes[1]);
  if (!(lower <= upper)) return {0.0f, -1.0f - static_cast<float>(padding)};
  const auto centre = static_cast<float>(0.5 * (lower + upper));
  const double half_size = std::max(upper - static_cast<double>(centre), static_cast<double>(centre) - lower) + padding;
  return {centre, std::nextafter(static_cast<float>(half_size), std::numeric_limits<float>::infinity())};
}

wt_float4 side_by_side(Centred a, Centred b) { return {a.centre, a.half_size, b.centre, b.half_size}; }

}  // namespace

// The half size is padded by 16 units in the last place of the largest distance: the slab test rounds four times, the
// sheared vertices of the triangle test three times, each by at most one unit of a coordinate or of a distance of twice
// that size.
std::vector<wt_centred_node> centred_nodes(std::span<const wt_bvh2_node> nodes, float extent_m) {
  const double padding = 16.0 * 6e-8 * 2.0 * static_cast<double>(extent_m);
  std::vector<wt_centred_node> out;
  out.reserve(nodes.size());
  for (const wt_bvh2_node& n : nodes)
    out.push_back({side_by_side(centred(n.left.x, padding), centred(n.left.y, padding)),
                   side_by_side(centred(n.right.x, padding), centred(n.right.y, padding)),
                   side_by_side(centred(n.left_z, padding), centred(n.right_z, padding)),
                   {n.child[0], n.child[1], 0, 0}});
  return out;
}

}  // namespace wavetracer
