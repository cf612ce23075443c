// SPDX-License-Identifier: Apache-2.0
// Boxes are those of the corners in float32; kernels add room for the rounding (lib/cone.clh).
#include "passes/beam_tree.hpp"

#include <algorithm>
#include <limits>

#include "accel/build.hpp"
#include "accel/layout.hpp"
#include "passes/advice.hpp"

namespace wavetracer {
namespace {

constexpr double box_limit = std::numeric_limits<double>::infinity();

// A triangle with the box of a facet; builders look at boxes alone.
AccelTriangle facet_box(const Facets& facets, uint32_t i) {
  const wt_facet& facet = facets.facets[i];
  glm::dvec3 low(box_limit), high(-box_limit);
  for (uint32_t k = 0; k < facet.count; ++k) {
    low = glm::min(low, facets.corners[facet.first_corner + k]);
    high = glm::max(high, facets.corners[facet.first_corner + k]);
  }
  AccelTriangle out{.v = {}, .primitive = i, .surface = facet.surface};
  for (int axis = 0; axis < 3; ++axis) {
    out.v[0][axis] = out.v[2][axis] = static_cast<float>(low[axis]);
    out.v[1][axis] = static_cast<float>(high[axis]);
  }
  return out;
}

// A tree of facets as it lies in the lists of a BeamTree, behind others.
struct Part {
  std::vector<wt_bvh2_node> nodes;
  std::vector<wt_facet> facets;
  std::vector<double> corners;
  Box box;
  uint32_t depth = 0;
};

// The part that begins at these places of the lists.
Part make_part(const Facets& facets, size_t first_node, size_t first_facet, size_t first_corner) {
  std::vector<AccelTriangle> boxes(facets.facets.size());
  for (uint32_t i = 0; i < boxes.size(); ++i) boxes[i] = facet_box(facets, i);
  BuildOptions options = BuildOptions::for_bvh2();
  options.max_leaf = 1;
  const BinaryTree binary = build_binary(boxes, options);
  const Bvh2 tree = make_bvh2(binary, boxes);
  Part out{.nodes = tree.nodes, .facets = {}, .corners = {}, .box = {}, .depth = tree.max_depth + 1};
  for (wt_bvh2_node& node : out.nodes)
    for (wt_int& child : node.child) {
      if (child >= 0)
        child += static_cast<wt_int>(first_node);
      else if (wt_leaf_end(child) > wt_leaf_first(child))
        child = wt_leaf(wt_leaf_first(child) + static_cast<uint32_t>(first_facet), 1);
    }
  for (const AccelTriangle& box : boxes)
    for (const auto& corner : box.v) out.box.grow(corner);
  for (const uint32_t i : binary.references) {
    out.facets.push_back(facets.facets[i]);
    wt_facet& facet = out.facets.back();
    const uint32_t first = facet.first_corner;
    facet.first_corner = static_cast<uint32_t>(first_corner + out.corners.size() / 3);
    for (uint32_t k = first; k < first + facet.count; ++k)
      for (int axis = 0; axis < 3; ++axis) out.corners.push_back(facets.corners[k][axis]);
  }
  return out;
}

// Writes elements behind the first ones of a list, which has room for them after that.
template <class T>
void put(gpu::Context& context, const std::vector<T>& elements, size_t first, gpu::Buffer<T>& list, const char* name) {
  const size_t wanted = first + std::max<size_t>(elements.size(), 1);
  if (list.size() < wanted) {
    auto more = context.buffer<T>(wanted, {name, advice::scene});
    if (first > 0) context.copy(list, more, first * sizeof(T), Stage::beam_gather);
    list = std::move(more);
  }
  list.write(elements, first, Stage::beam_gather);
}

}  // namespace

BeamTreeBuilder::BeamTreeBuilder(gpu::Context& context, const Facets& fixed) : context_(context) {
  const Part part = make_part(fixed, BeamTree::fixed_root, 0, 0);
  top_ = lonely_root(part.box, BeamTree::fixed_root);
  fixed_nodes_ = BeamTree::fixed_root + part.nodes.size();
  fixed_facets_ = part.facets.size();
  fixed_corners_ = part.corners.size();
  fixed_depth_ = part.depth;
  tree_.nodes = context.buffer<wt_bvh2_node>(fixed_nodes_, {"beam tree", advice::scene});
  tree_.nodes.write(part.nodes, BeamTree::fixed_root);
  tree_.facets = context.buffer(part.facets, {"beam facets", advice::scene});
  tree_.corners = context.buffer(part.corners, {"beam facets", advice::scene});
  place({});
}

void BeamTreeBuilder::place(const Facets& moving) {
  tree_.has_moving = !moving.facets.empty();
  wt_bvh2_node top = top_;
  tree_.depth = fixed_depth_ + 1;
  if (tree_.has_moving) {
    const Part part = make_part(moving, fixed_nodes_, fixed_facets_, fixed_corners_ / 3);
    put(context_, part.nodes, fixed_nodes_, tree_.nodes, "beam tree");
    put(context_, part.facets, fixed_facets_, tree_.facets, "beam facets");
    put(context_, part.corners, fixed_corners_, tree_.corners, "beam facets");
    store_child(top, 1, part.box, static_cast<int32_t>(fixed_nodes_));
    tree_.depth = std::max(fixed_depth_, part.depth) + 1;
  }
  tree_.nodes.write({&top, 1}, 0, Stage::beam_gather);
}

BeamTree make_beam_tree(gpu::Context& context, const Facets& fixed) { return BeamTreeBuilder(context, fixed).tree(); }

}  // namespace wavetracer
