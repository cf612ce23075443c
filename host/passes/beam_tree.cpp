// SPDX-License-Identifier: Apache-2.0
// Boxes are those of the corners in float32; kernels add room for the rounding (lib/cone.clh).
#include "passes/beam_tree.hpp"

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

}  // namespace

BeamTree make_beam_tree(gpu::Context& context, const Facets& facets) {
  std::vector<AccelTriangle> boxes(facets.facets.size());
  for (uint32_t i = 0; i < boxes.size(); ++i) boxes[i] = facet_box(facets, i);
  BuildOptions options = BuildOptions::for_bvh2();
  options.max_leaf = 1;
  const BinaryTree binary = build_binary(boxes, options);
  const Bvh2 tree = make_bvh2(binary, boxes);
  std::vector<wt_facet> ordered;
  std::vector<double> corners;
  for (const uint32_t i : binary.references) {
    ordered.push_back(facets.facets[i]);
    wt_facet& facet = ordered.back();
    const uint32_t first = facet.first_corner;
    facet.first_corner = static_cast<uint32_t>(corners.size() / 3);
    for (uint32_t k = first; k < first + facet.count; ++k)
      for (int axis = 0; axis < 3; ++axis) corners.push_back(facets.corners[k][axis]);
  }
  return {.nodes = context.buffer(tree.nodes, {"beam tree", advice::scene}),
          .facets = context.buffer(ordered, {"beam facets", advice::scene}),
          .corners = context.buffer(corners, {"beam facets", advice::scene}),
          .depth = tree.max_depth + 1};
}

}  // namespace wavetracer
