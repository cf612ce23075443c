// SPDX-License-Identifier: Apache-2.0
// A tree of spheres about facets, so that a question about all facets asks few of them.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace wavetracer {

struct Sphere {
  glm::dvec3 centre;
  double radius_m;
};

class FacetTree {
 public:
  FacetTree() = default;
  // spheres: those of the facets, by their number.
  explicit FacetTree(const std::vector<Sphere>& spheres);

  // Calls take(facet) for each facet whose sphere, and all spheres about it, may(sphere) accepts. may must accept a
  // sphere about any sphere that it accepts.
  template <class May, class Take>
  void visit(const May& may, const Take& take) const {
    std::vector<uint32_t> waiting;
    if (!nodes_.empty()) waiting.push_back(0);
    while (!waiting.empty()) {
      const Node& node = nodes_[waiting.back()];
      waiting.pop_back();
      if (!may(node.sphere)) continue;
      if (node.count == 0) {
        waiting.push_back(node.first);
        waiting.push_back(node.first + 1);
      }
      for (uint32_t i = node.first; i < node.first + node.count; ++i) take(order_[i]);
    }
  }

 private:
  struct Node {
    Sphere sphere;
    uint32_t first, count;  // facets of a leaf, or with count 0 the first of two children
  };
  void split(const std::vector<Sphere>& spheres, uint32_t node, uint32_t first, uint32_t count);

  std::vector<Node> nodes_;
  std::vector<uint32_t> order_;
};

}  // namespace wavetracer
