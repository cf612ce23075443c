// SPDX-License-Identifier: Apache-2.0
// It uses median splits: surface areas matter little if all boxes are vehicles.
// The layout is that of a BVH2, wavetracer/device/bvh.h.
#include "accel/instance_tree.hpp"

#include <algorithm>
#include <numeric>

#include "accel/layout.hpp"

namespace wavetracer {
namespace {

class Builder {
 public:
  Builder(std::span<const Box> boxes, TopLevel& out) : boxes_(boxes), out_(out) {}

  // Writes the node over the boxes order[first .. last - 1], at least two; returns its index and sets its box.
  int32_t node(size_t first, size_t last, Box& box) {
    Box centres;
    for (size_t i = first; i < last; ++i) {
      const Box& b = boxes_[out_.order[i]];
      const float twice_centre[3] = {b.lower[0] + b.upper[0], b.lower[1] + b.upper[1], b.lower[2] + b.upper[2]};
      centres.grow(twice_centre);
    }
    int axis = 0;
    for (int other = 1; other < 3; ++other)
      if (centres.upper[other] - centres.lower[other] > centres.upper[axis] - centres.lower[axis]) axis = other;
    const size_t middle = first + (last - first) / 2;
    const auto begin = out_.order.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(last), [&](uint32_t a, uint32_t b) {
                       const float x = boxes_[a].lower[axis] + boxes_[a].upper[axis];
                       const float y = boxes_[b].lower[axis] + boxes_[b].upper[axis];
                       return x < y || (x == y && a < b);  // makes the tree independent of the standard library
                     });
    const size_t at = out_.nodes.size();
    out_.nodes.push_back({});
    Box left, right;
    const int32_t left_child = child(first, middle, left), right_child = child(middle, last, right);
    store_child(out_.nodes[at], 0, left, left_child);
    store_child(out_.nodes[at], 1, right, right_child);
    box.grow(left);
    box.grow(right);
    return static_cast<int32_t>(at);
  }

 private:
  int32_t child(size_t first, size_t last, Box& box) {
    if (last - first > 1) return node(first, last, box);
    box = boxes_[out_.order[first]];
    return wt_leaf(static_cast<uint32_t>(first), 1);
  }

  std::span<const Box> boxes_;
  TopLevel& out_;
};

}  // namespace

TopLevel build_top_level(std::span<const Box> boxes) {
  TopLevel out;
  out.order.resize(boxes.size());
  std::iota(out.order.begin(), out.order.end(), 0u);
  Builder builder(boxes, out);
  Box whole;
  if (boxes.size() > 1)
    builder.node(0, boxes.size(), whole);
  else
    out.nodes.push_back(boxes.empty() ? lonely_root(Box{}, wt_leaf(0, 0)) : lonely_root(boxes[0], wt_leaf(0, 1)));
  return out;
}

}  // namespace wavetracer
