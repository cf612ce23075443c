// SPDX-License-Identifier: Apache-2.0
#include "passes/receiver_groups.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "passes/upload.hpp"

namespace wavetracer {
namespace {

struct Extent {
  std::array<float, 3> lower, upper;
};

Extent extent_of(std::span<const uint32_t> points, const std::vector<float>& positions) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Extent out{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const uint32_t point : points)
    for (size_t axis = 0; axis < 3; ++axis) {
      const float at = positions[3 * size_t{point} + axis];
      out.lower[axis] = std::min(out.lower[axis], at);
      out.upper[axis] = std::max(out.upper[axis], at);
    }
  return out;
}

void halve(std::span<uint32_t> points, const std::vector<float>& positions) {
  constexpr size_t group = ReceiverGroups::size, area = group * group;
  if (points.size() <= group) return;
  const Extent extent = extent_of(points, positions);
  size_t longest = 0;
  for (size_t axis = 1; axis < 3; ++axis)
    if (extent.upper[axis] - extent.lower[axis] > extent.upper[longest] - extent.lower[longest]) longest = axis;
  const size_t unit = points.size() > area ? area : group;
  const size_t half = (points.size() + unit - 1) / unit / 2 * unit;
  std::ranges::nth_element(points, points.begin() + static_cast<ptrdiff_t>(half), {},
                           [&](uint32_t point) { return positions[3 * size_t{point} + longest]; });
  halve(points.first(half), positions);
  halve(points.subspan(half), positions);
}

// Returns six planes: for every `each` points the middle of their box, and half of its size. Boxes are added until
// their number is a multiple of ReceiverGroups::together.
std::vector<float> box_planes(std::span<const uint32_t> points, size_t each, const std::vector<float>& positions) {
  constexpr size_t step = ReceiverGroups::together;
  const size_t count = (points.size() + each - 1) / each, stride = (count + step - 1) / step * step;
  std::vector<float> planes(6 * stride, 0.0f);
  for (size_t box = 0; box < count; ++box) {
    const size_t first = box * each;
    const Extent extent = extent_of(points.subspan(first, std::min(each, points.size() - first)), positions);
    for (size_t axis = 0; axis < 3; ++axis) {
      const float middle = 0.5f * (extent.lower[axis] + extent.upper[axis]);
      planes[axis * stride + box] = middle;
      planes[(3 + axis) * stride + box] = std::max(extent.upper[axis] - middle, middle - extent.lower[axis]);
    }
  }
  return planes;
}

}  // namespace

std::vector<uint32_t> grouped(const std::vector<float>& positions) {
  std::vector<uint32_t> out(positions.size() / 3);
  for (size_t i = 0; i < out.size(); ++i) out[i] = static_cast<uint32_t>(i);
  halve(out, positions);
  return out;
}

bool ReceiverGroups::moved(const std::vector<EndState>& receivers, const std::vector<Link>& wanted) {
  std::vector<char> has_link(receivers.size(), 0);
  for (const Link& link : wanted) has_link[link.rx] = 1;
  std::vector<uint32_t> linked;
  std::vector<float> now;
  for (uint32_t receiver = 0; receiver < receivers.size(); ++receiver) {
    if (!has_link[receiver]) continue;
    linked.push_back(receiver);
    for (int axis = 0; axis < 3; ++axis) now.push_back(static_cast<float>(receivers[receiver].position_m[axis]));
  }
  if (linked == linked_ && now == positions_ && places) return false;
  linked_ = std::move(linked);
  positions_ = std::move(now);
  return true;
}

void ReceiverGroups::set_places(gpu::Context& context, size_t receivers) {
  std::vector<uint32_t> at = grouped(positions_);  // places in the list of linked receivers
  place_of_.resize(receivers);
  for (size_t place = 0; place < at.size(); ++place) place_of_[linked_[at[place]]] = static_cast<uint32_t>(place);
  constexpr size_t step = size_t{size} * together;
  at.resize((at.size() + step - 1) / step * step, at.empty() ? 0 : at.back());  // no link names the added places
  capacity = static_cast<uint32_t>(at.size());
  std::vector<float> planes(3 * at.size());
  for (size_t axis = 0; axis < 3; ++axis)
    for (size_t place = 0; place < at.size(); ++place)
      planes[axis * at.size() + place] = positions_[3 * size_t{at[place]} + axis];
  std::vector<uint32_t> receiver_at;
  for (const uint32_t point : at) receiver_at.push_back(linked_[point]);
  upload(context, order, receiver_at, "receivers in groups");
  upload(context, places, planes, "places of receivers");
  upload(context, boxes, box_planes(at, size, positions_), "boxes of receivers");
  upload(context, areas, box_planes(at, size_t{size} * size, positions_), "areas of receivers");
}

void ReceiverGroups::set(gpu::Context& context, const std::vector<EndState>& receivers, uint32_t transmitter_count,
                         const std::vector<Link>& wanted) {
  if (wanted.empty()) {
    capacity = 0;
    linked_.clear();
    positions_.clear();
    return;
  }
  if (moved(receivers, wanted)) set_places(context, receivers.size());
  upload_changed(
      context, links, link_words_,
      link_bits(transmitter_count, capacity / size, wanted, [&](uint32_t receiver) { return place_of_[receiver]; }),
      "links of groups");
}

}  // namespace wavetracer
