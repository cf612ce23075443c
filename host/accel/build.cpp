// SPDX-License-Identifier: Apache-2.0
// The recursion of the builder: leaf, object split, spatial split or halving, one task per subtree; then flattening.
// Each node owns its references, so subtrees are independent and the tree is the same for any number of threads.
#include "accel/build.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <bit>
#include <memory>
#include <string>
#include <utility>

#include "accel/split.hpp"
#include "wavetracer/device/bvh.h"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using accel::Bounds;
using accel::Halves;
using accel::Reference;
using accel::Split;

constexpr size_t kParallelSubtree = 1024;  // one task builds a smaller subtree

struct Subtree {
  Box box;
  std::unique_ptr<Subtree> left, right;
  std::vector<uint32_t> triangles;  // triangles of a leaf
  size_t node_count = 1, reference_count = 0;
};

// Returns how many levels of halving are needed below a node until leaves hold at most max_leaf references.
uint32_t levels_needed(size_t count, uint32_t max_leaf) {
  const size_t leaves = (count + max_leaf - 1) / max_leaf;
  return static_cast<uint32_t>(std::bit_width(leaves - 1));
}

class Builder {
 public:
  Builder(std::span<const AccelTriangle> triangles, const BuildOptions& options, double root_area)
      : triangles_(triangles), options_(options), root_area_(root_area) {}

  // budget: number of references that spatial splits may still add below this node.
  std::unique_ptr<Subtree> build(std::vector<Reference> references, uint32_t depth, size_t budget) const {
    const Bounds bounds = accel::bounds_of(references);
    auto node = std::make_unique<Subtree>();
    node->box = bounds.box;
    Halves halves = divide(references, bounds, depth, budget);
    if (halves.left.empty()) {
      for (const Reference& reference : references) node->triangles.push_back(reference.triangle);
      node->reference_count = references.size();
      return node;
    }
    const size_t count = references.size(), left_count = halves.left.size(), right_count = halves.right.size();
    budget -= left_count + right_count - count;
    const size_t left_budget = budget * left_count / (left_count + right_count);
    std::vector<Reference>().swap(references);
    const auto build_left = [&] { node->left = build(std::move(halves.left), depth + 1, left_budget); };
    const auto build_right = [&] { node->right = build(std::move(halves.right), depth + 1, budget - left_budget); };
    if (count >= kParallelSubtree) {
      tbb::parallel_invoke(build_left, build_right);
    } else {
      build_left();
      build_right();
    }
    node->node_count += node->left->node_count + node->right->node_count;
    node->reference_count = node->left->reference_count + node->right->reference_count;
    return node;
  }

 private:
  std::span<const AccelTriangle> triangles_;
  const BuildOptions& options_;
  double root_area_;

  // Returns empty halves if the node should be a leaf.
  Halves divide(std::span<const Reference> references, const Bounds& bounds, uint32_t depth, size_t budget) const {
    const size_t count = references.size();
    const bool may_be_leaf = count <= options_.max_leaf;
    if (count == 1) return {};
    if (levels_needed(count, options_.max_leaf) >= options_.max_depth - depth) {
      return may_be_leaf ? Halves{} : accel::split_median(references, bounds.centers);
    }
    const Split object = accel::find_object_split(references, bounds, options_.block);
    Split space;
    if (options_.spatial_splits && budget > 0 && overlap(object) > static_cast<double>(options_.overlap) * root_area_) {
      space = accel::find_spatial_split(triangles_, references, bounds.box, options_.block);
    }
    if (may_be_leaf) {
      const double split_cost = options_.node_cost * bounds.box.half_area() + std::min(object.cost, space.cost);
      if (accel::test_count(count, options_.block) * bounds.box.half_area() <= split_cost) return {};
    }
    if (space.cost < object.cost && space.left_count + space.right_count <= count + budget) {
      Halves halves = accel::split_space(triangles_, references, bounds.box, space);
      // A side may be as large as the whole: such a cut uses up budget, which ends the recursion.
      const bool cut = !halves.left.empty() && !halves.right.empty();
      if (cut && halves.left.size() + halves.right.size() <= count + budget) return halves;
    }
    if (object.axis >= 0) return accel::split_objects(references, bounds.centers, object);
    return may_be_leaf ? Halves{} : accel::split_median(references, bounds.centers);
  }

  // Returns the half area that both children of an object split cover, or the whole half area if no plane divides the
  // centres.
  double overlap(const Split& object) const {
    if (object.axis < 0) return root_area_;
    Box common = object.left;
    common.clip(object.right);
    return common.half_area();
  }
};

uint32_t flatten(const Subtree& subtree, uint32_t depth, BinaryTree& tree) {
  const auto index = static_cast<uint32_t>(tree.nodes.size());
  const auto first = static_cast<uint32_t>(tree.references.size());
  tree.nodes.push_back({subtree.box, 0, 0, first, static_cast<uint32_t>(subtree.reference_count)});
  if (subtree.left) {
    const uint32_t left = flatten(*subtree.left, depth + 1, tree), right = flatten(*subtree.right, depth + 1, tree);
    tree.nodes[index].left = left;
    tree.nodes[index].right = right;
  } else {
    tree.references.insert(tree.references.end(), subtree.triangles.begin(), subtree.triangles.end());
    tree.max_depth = std::max(tree.max_depth, depth);
  }
  return index;
}

void check(size_t count, const BuildOptions& options) {
  constexpr uint32_t leaf_limit = (1u << WT_LEAF_BITS) - 1;
  constexpr size_t reference_limit = size_t{1} << (31 - WT_LEAF_BITS);
  if (options.max_leaf < 1 || options.max_leaf > leaf_limit || options.block < 1) {
    throw RuntimeError("a leaf of the acceleration structure holds 1 to " + std::to_string(leaf_limit) +
                       " triangles, not " + std::to_string(options.max_leaf) + ", and tests at least one at once");
  }
  if (static_cast<double>(count) * (1 + static_cast<double>(options.duplication)) >=
      static_cast<double>(reference_limit)) {
    throw RuntimeError("the scene has " + std::to_string(count) +
                       " triangles and the acceleration structure can refer to " + std::to_string(reference_limit) +
                       ", copies by spatial splits included; cut the scene into parts");
  }
  if (count > 0 && levels_needed(count, options.max_leaf) > options.max_depth) {
    throw RuntimeError("a tree of " + std::to_string(count) + " triangles needs " +
                       std::to_string(levels_needed(count, options.max_leaf)) + " levels, but max_depth is " +
                       std::to_string(options.max_depth) + "; raise it");
  }
}

}  // namespace

BinaryTree build_binary(std::span<const AccelTriangle> triangles, const BuildOptions& options) {
  check(triangles.size(), options);
  BinaryTree tree;
  if (triangles.empty()) return tree;
  std::vector<Reference> references(triangles.size());
  tbb::parallel_for(size_t{0}, triangles.size(), [&](size_t i) {
    references[i].triangle = static_cast<uint32_t>(i);
    for (const auto& vertex : triangles[i].v) references[i].box.grow(vertex);
  });
  const double root_area = accel::bounds_of(references).box.half_area();
  const auto budget =
      static_cast<size_t>(static_cast<double>(options.duplication) * static_cast<double>(triangles.size()));
  const auto root =
      Builder(triangles, options, root_area).build(std::move(references), 0, options.spatial_splits ? budget : 0);
  tree.nodes.reserve(root->node_count);
  tree.references.reserve(root->reference_count);
  flatten(*root, 0, tree);
  return tree;
}

double sah_cost(const BinaryTree& tree, const BuildOptions& options) {
  if (tree.nodes.empty()) return 0;
  double sum = 0;
  for (const BinaryNode& node : tree.nodes) {
    const double tests =
        node.left != 0 ? static_cast<double>(options.node_cost) : accel::test_count(node.count, options.block);
    sum += tests * node.box.half_area();
  }
  const double root_area = tree.nodes[0].box.half_area();
  return root_area > 0 ? sum / root_area : 0;
}

}  // namespace wavetracer
