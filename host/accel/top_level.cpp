// Median splits: surface areas matter little where all boxes are vehicles.
// The layout is that of a BVH2, wavetracer/device/bvh.h.
#include "accel/top_level.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "wavetracer/device/bvh.h"

namespace wavetracer {
namespace {

int32_t leaf_reference(size_t first, uint32_t count) {
  return ~static_cast<int32_t>((static_cast<uint32_t>(first) << WT_LEAF_BITS) | count);
}

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
                       return x < y || (x == y && a < b);  // the same tree whatever the library does
                     });
    const size_t at = out_.nodes.size();
    out_.nodes.resize(at + WT_BVH2_NODE_FLOATS, 0.0f);
    Box left, right;
    const int32_t left_child = child(first, middle, left), right_child = child(middle, last, right);
    store(at, 0, left, left_child);
    store(at, 1, right, right_child);
    box.grow(left);
    box.grow(right);
    return static_cast<int32_t>(at / WT_BVH2_NODE_FLOATS);
  }

  // A root over one box or none.
  void lonely_root() {
    out_.nodes.resize(WT_BVH2_NODE_FLOATS, 0.0f);
    const bool any = !boxes_.empty();
    store(0, 0, any ? boxes_[0] : Box{}, leaf_reference(0, any));
    store(0, 1, Box{}, leaf_reference(0, 0));
  }

 private:
  int32_t child(size_t first, size_t last, Box& box) {
    if (last - first > 1) return node(first, last, box);
    box = boxes_[out_.order[first]];
    return leaf_reference(first, 1);
  }

  void store(size_t node, size_t side, const Box& box, int32_t child) {
    float *xy = &out_.nodes[node + 4 * side], *z = &out_.nodes[node + 8 + 2 * side];
    xy[0] = box.lower[0];
    xy[1] = box.upper[0];
    xy[2] = box.lower[1];
    xy[3] = box.upper[1];
    z[0] = box.lower[2];
    z[1] = box.upper[2];
    out_.nodes[node + 12 + side] = std::bit_cast<float>(child);
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
    builder.lonely_root();
  return out;
}

}  // namespace wavetracer
