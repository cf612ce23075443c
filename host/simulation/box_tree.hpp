// SPDX-License-Identifier: Apache-2.0
// Finds the boxes that a point is in or near: a binary tree over boxes that do not move, halved at the median of its
// longest axis. It is built once, and searched for every antenna of every frame.
#pragma once
#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <numeric>
#include <vector>

namespace wavetracer {

struct TreeBox {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()}, upper{-std::numeric_limits<double>::infinity()};
  void add(const TreeBox& other) {
    lower = glm::min(lower, other.lower);
    upper = glm::max(upper, other.upper);
  }
  bool holds(const glm::dvec3& p, double margin_m) const {
    return glm::all(glm::greaterThanEqual(p, lower - margin_m)) && glm::all(glm::lessThanEqual(p, upper + margin_m));
  }
};

class BoxTree {
 public:
  explicit BoxTree(std::vector<TreeBox> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!boxes_.empty()) build(0, static_cast<uint32_t>(boxes_.size()));
  }
  // Calls visit(number) for every box that the point is in, or at most margin_m beside.
  template <class Visit>
  void at(const glm::dvec3& p, double margin_m, const Visit& visit) const {
    for (uint32_t n = 0; n < nodes_.size();) {
      const Node& node = nodes_[n];
      if (!node.box.holds(p, margin_m)) {
        n = node.next;
        continue;
      }
      for (uint32_t k = node.first; k < node.end; ++k)
        if (boxes_[order_[k]].holds(p, margin_m)) visit(order_[k]);
      ++n;
    }
  }

 private:
  // Nodes are in the order of a walk: the children of a node follow it, and `next` is the first node that is not below
  // it. Only leaves have boxes, first .. end - 1 of order_.
  struct Node {
    TreeBox box;
    uint32_t next, first, end;
  };
  static constexpr uint32_t most_in_leaf = 4;

  void build(uint32_t first, uint32_t end) {
    const size_t n = nodes_.size();
    nodes_.push_back({{}, 0, first, end});
    TreeBox box;
    for (uint32_t k = first; k < end; ++k) box.add(boxes_[order_[k]]);
    nodes_[n].box = box;
    if (end - first > most_in_leaf) {
      nodes_[n].end = first;
      const glm::dvec3 size = box.upper - box.lower;
      const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
      const uint32_t middle = first + (end - first) / 2;
      std::nth_element(
          order_.begin() + first, order_.begin() + middle, order_.begin() + end, [&](uint32_t a, uint32_t b) {
            return boxes_[a].lower[axis] + boxes_[a].upper[axis] < boxes_[b].lower[axis] + boxes_[b].upper[axis];
          });
      build(first, middle);
      build(middle, end);
    }
    nodes_[n].next = static_cast<uint32_t>(nodes_.size());
  }

  std::vector<TreeBox> boxes_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace wavetracer
