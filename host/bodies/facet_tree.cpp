// SPDX-License-Identifier: Apache-2.0
// Spheres are halved at the median of their centres along the axis on which these extend farthest.
#include "bodies/facet_tree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

namespace wavetracer {
namespace {

constexpr uint32_t most_facets_of_leaf = 4;

}  // namespace

FacetTree::FacetTree(const std::vector<Sphere>& spheres) : order_(spheres.size()) {
  if (spheres.empty()) return;
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(2 * spheres.size());
  nodes_.push_back({});
  split(spheres, 0, 0, static_cast<uint32_t>(spheres.size()));
}

void FacetTree::split(const std::vector<Sphere>& spheres, uint32_t node, uint32_t first, uint32_t count) {
  glm::dvec3 lower(INFINITY), upper(-INFINITY);
  for (uint32_t i = first; i < first + count; ++i) {
    lower = glm::min(lower, spheres[order_[i]].centre);
    upper = glm::max(upper, spheres[order_[i]].centre);
  }
  Sphere about{0.5 * (lower + upper), 0};
  for (uint32_t i = first; i < first + count; ++i) {
    const Sphere& one = spheres[order_[i]];
    about.radius_m = std::max(about.radius_m, glm::length(one.centre - about.centre) + one.radius_m);
  }
  about.radius_m *= 1 + 1e-12;
  if (count <= most_facets_of_leaf) {
    nodes_[node] = {about, first, count};
    return;
  }
  const glm::dvec3 size = upper - lower;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count,
                   [&](uint32_t a, uint32_t b) { return spheres[a].centre[axis] < spheres[b].centre[axis]; });
  const auto child = static_cast<uint32_t>(nodes_.size());
  nodes_[node] = {about, child, 0};
  nodes_.resize(nodes_.size() + 2);
  split(spheres, child, first, half);
  split(spheres, child + 1, first + half, count - half);
}

}  // namespace wavetracer
