// SPDX-License-Identifier: Apache-2.0
// The BVH8 layout: the optimal collapse of a binary tree by dynamic programming, and blocks of four triangles. The tree
// must be built down to small leaves; a binary leaf is never divided.
#include <array>
#include <limits>
#include <string>

#include "accel/layout.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr uint32_t kWidth = 8, kBlock = 4;

uint32_t block_count(uint32_t triangles) { return (triangles + kBlock - 1) / kBlock; }

// The representation of a binary node in the eight-wide tree.
struct Plan {
  // forest[i]: least cost of at most i + 1 subtrees that cover the node's triangles.
  std::array<float, kWidth - 1> forest;
  // left_share[i]: number of them that the left child gets; 0 if fewer than i + 1 subtrees cover the node best.
  // left_share[0] is 0; the last entry is for eight, which the node gets as the children of an eight-wide node.
  std::array<uint8_t, kWidth> left_share;
  bool leaf;
};

// Computes costs from the leaves up: children follow their parents in the tree, so a backward sweep meets them first.
std::vector<Plan> plan_collapse(const BinaryTree& tree, const CollapseOptions& options) {
  std::vector<Plan> plans(tree.nodes.size());
  const double root_area = tree.nodes.empty() ? 0 : tree.nodes[0].box.half_area();
  const double scale = root_area > 0 ? 1 / root_area : 0;  // without area, every tree has the same cost
  for (size_t index = tree.nodes.size(); index-- > 0;) {
    const BinaryNode& node = tree.nodes[index];
    Plan& plan = plans[index];
    plan.left_share.fill(0);
    const auto area = static_cast<float>(node.box.half_area() * scale);
    const float as_leaf = node.count <= options.max_leaf || node.left == 0
                              ? area * static_cast<float>(block_count(node.count))
                              : std::numeric_limits<float>::infinity();
    plan.leaf = true;
    plan.forest.fill(as_leaf);
    if (node.left == 0) continue;

    const Plan &left = plans[node.left], &right = plans[node.right];
    const auto distribute = [&](size_t roots) {
      float best = std::numeric_limits<float>::infinity();
      for (size_t share = std::min<size_t>(roots - 1, kWidth - 1); share > 0 && roots - share < kWidth; share--) {
        const float cost = left.forest[share - 1] + right.forest[roots - share - 1];
        if (cost < best) {
          best = cost;
          plan.left_share[roots - 1] = static_cast<uint8_t>(share);
        }
      }
      return best;
    };
    // The root is always an inner node, so its cost does not count.
    const float as_inner = distribute(kWidth) + (index > 0 ? options.node_cost * area : 0.0f);
    plan.leaf = as_leaf <= as_inner;
    plan.forest[0] = std::min(as_leaf, as_inner);
    for (size_t roots = 2; roots < kWidth; roots++) {
      const float divided = distribute(roots);
      plan.forest[roots - 1] = std::min(divided, plan.forest[roots - 2]);
      if (divided >= plan.forest[roots - 2]) plan.left_share[roots - 1] = 0;
    }
  }
  return plans;
}

class Writer {
 public:
  Writer(const BinaryTree& tree, std::span<const AccelTriangle> triangles, const std::vector<Plan>& plans, Bvh8& out)
      : tree_(tree), triangles_(triangles), plans_(plans), out_(out) {}

  // Writes the eight-wide node of these binary nodes and all nodes below it, in depth-first order.
  int32_t inner(const std::vector<uint32_t>& children, uint32_t depth) {
    const size_t at = out_.nodes.size();
    out_.nodes.push_back({});
    out_.max_depth = std::max(out_.max_depth, depth);
    for (size_t lane = 0; lane < kWidth; lane++) {
      const bool used = lane < children.size();
      const Box box = used ? tree_.nodes[children[lane]].box : Box{};
      const int32_t reference = used ? child(children[lane], depth + 1) : wt_leaf(0, 0);
      wt_bvh8_node& node = out_.nodes[at];
      for (size_t axis = 0; axis < 3; axis++) {
        node.planes[axis].s[lane] = box.lower[axis];
        node.planes[3 + axis].s[lane] = box.upper[axis];
      }
      node.child[lane] = reference;
    }
    return static_cast<int32_t>(at);
  }

  // Collects the binary nodes that cover `index` with at most `roots` subtrees, as planned.
  void gather(uint32_t index, uint32_t roots, std::vector<uint32_t>& out) const {
    const Plan& plan = plans_[index];
    while (roots > 1 && roots < kWidth && plan.left_share[roots - 1] == 0) roots--;
    if (roots == 1) {
      out.push_back(index);
      return;
    }
    const uint32_t share = plan.left_share[roots - 1];
    gather(tree_.nodes[index].left, share, out);
    gather(tree_.nodes[index].right, roots - share, out);
  }

 private:
  const BinaryTree& tree_;
  std::span<const AccelTriangle> triangles_;
  const std::vector<Plan>& plans_;
  Bvh8& out_;

  int32_t child(uint32_t index, uint32_t depth) {
    if (plans_[index].leaf) return leaf(tree_.nodes[index]);
    std::vector<uint32_t> children;
    gather(index, kWidth, children);
    return inner(children, depth);
  }

  int32_t leaf(const BinaryNode& node) {
    // Spatial splits may have put parts of a triangle into different leaves that are joined here; one part is enough.
    std::vector<uint32_t> members;
    for (uint32_t i = node.first; i < node.first + node.count; i++) {
      const uint32_t triangle = tree_.references[i];
      if (std::find(members.begin(), members.end(), triangle) == members.end()) members.push_back(triangle);
    }
    const auto first = static_cast<uint32_t>(out_.blocks.size());
    const uint32_t count = block_count(static_cast<uint32_t>(members.size()));
    if (count >= 1u << WT_LEAF_BITS || first >= 1u << (31 - WT_LEAF_BITS)) {
      throw RuntimeError("block " + std::to_string(first) + " of " + std::to_string(members.size()) +
                         " triangles does not fit a leaf of a BVH8; lower max_leaf or cut the scene into parts");
    }
    for (uint32_t block = 0; block < count; block++) {
      const size_t begin = block * kBlock, size = std::min<size_t>(kBlock, members.size() - begin);
      std::array<uint32_t, kBlock> four;
      for (size_t lane = 0; lane < kBlock; lane++) four[lane] = members[begin + (lane < size ? lane : 0)];
      append(four);
    }
    return wt_leaf(first, count);
  }

  void append(const std::array<uint32_t, kBlock>& four) {
    wt_triangle_block& block = out_.blocks.emplace_back();
    for (size_t lane = 0; lane < kBlock; lane++) {
      const AccelTriangle& triangle = triangles_[four[lane]];
      for (size_t row = 0; row < 9; row++) block.corner[row].s[lane] = triangle.v[row / 3][row % 3];
      block.primitive.s[lane] = triangle.primitive;
      block.surface.s[lane] = triangle.surface;
    }
  }
};

}  // namespace

Bvh8 make_bvh8(const BinaryTree& tree, std::span<const AccelTriangle> triangles, const CollapseOptions& options) {
  Bvh8 out;
  const std::vector<Plan> plans = plan_collapse(tree, options);
  Writer writer(tree, triangles, plans, out);
  std::vector<uint32_t> children;
  if (!tree.nodes.empty()) {
    if (plans[0].leaf) {
      children.push_back(0);
    } else {
      writer.gather(0, kWidth, children);
    }
  }
  writer.inner(children, 1);
  return out;
}

}  // namespace wavetracer
