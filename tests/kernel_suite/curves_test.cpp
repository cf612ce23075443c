// SPDX-License-Identifier: Apache-2.0
// The public CurveKeys: points that are sorted by their keys, against std::sort with an order that makes no keys; the
// walk of Hilbert curves from cell to neighbouring cell.
#include "wavetracer/kernels/curves.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "contains.hpp"
#include "gpu/temporary.hpp"
#include "kernel_suite/soup.hpp"
#include "kernel_suite/user.hpp"
#include "wavetracer/kernels/sort.hpp"

using namespace wavetracer::test;
namespace kernels = wavetracer::kernels;

namespace {

std::vector<float> unit_points(size_t n, size_t dimensions) {
  Numbers numbers(3);
  std::vector<float> points(n * dimensions);
  for (float& x : points) x = numbers.between(0, 1);
  return points;
}

// Is cell a before b in Morton order? The component with the highest differing bit decides, the last one if several
// have it (T. Chan, "A minimalist's implementation of an approximate nearest neighbor algorithm", 2006).
bool morton_before(const std::vector<uint32_t>& cells, size_t dimensions, uint32_t a, uint32_t b) {
  size_t deciding = dimensions - 1;
  uint32_t highest = 0;
  for (size_t d = dimensions; d-- > 0;) {
    const uint32_t difference = cells[a * dimensions + d] ^ cells[b * dimensions + d];
    if (highest < difference && highest < (highest ^ difference)) {
      deciding = d;
      highest = difference;
    }
  }
  return cells[a * dimensions + deciding] < cells[b * dimensions + deciding];
}

template <class Key>
std::vector<uint32_t> sorted_by_keys(const kernels::Context& context, kernels::Curve curve,
                                     const std::vector<float>& points, uint64_t cells) {
  kernels::CurveKeys keys_of(context, curve, sizeof(Key) * 8);
  const size_t n = points.size() / keys_of.dimensions();
  kernels::Sort sort(context, {.key_bits = sizeof(Key) * 8, .payload = kernels::Payload::index});
  const auto from = context.buffer<float>(points.size());
  const auto keys = context.buffer<Key>(n);
  const auto order = context.buffer<uint32_t>(n);
  from.write(points);
  const std::vector<float> lower(keys_of.dimensions(), 0.0f), upper(keys_of.dimensions(), 1.0f);
  keys_of(from, n, {lower, upper, cells}, keys);
  sort(keys, order, n, {0, keys_of.bits(cells)});
  return order.read();
}

}  // namespace

TEST_CASE("points that are sorted by Morton keys are in the order of std::sort without keys") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  for (const auto& [curve, dimensions] :
       {std::pair{kernels::Curve::morton2, 2u}, {kernels::Curve::morton3, 3u}, {kernels::Curve::morton5, 5u}}) {
    CAPTURE(dimensions);
    const uint64_t cells = dimensions == 5 ? 64 : 1024;
    const std::vector<float> points = unit_points(3000, dimensions);
    std::vector<uint32_t> cell(points.size()), expected(3000);
    std::transform(points.begin(), points.end(), cell.begin(),
                   [&](float x) { return static_cast<uint32_t>(x * static_cast<float>(cells)); });
    std::iota(expected.begin(), expected.end(), 0u);
    std::stable_sort(expected.begin(), expected.end(),
                     [&, count = dimensions](uint32_t a, uint32_t b) { return morton_before(cell, count, a, b); });
    CHECK(sorted_by_keys<uint32_t>(context, curve, points, cells) == expected);
    CHECK(sorted_by_keys<uint64_t>(context, curve, points, cells) == expected);
  }
}

TEST_CASE("points in the order of Hilbert keys walk from a cell to its neighbour") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  for (const auto& [curve, dimensions] :
       {std::pair{kernels::Curve::hilbert2, size_t{2}}, {kernels::Curve::hilbert3, size_t{3}}}) {
    CAPTURE(dimensions);
    const uint32_t side = 8;
    std::vector<float> points;
    const uint32_t count = dimensions == 2 ? side * side : side * side * side;
    for (uint32_t i = 0; i < count; ++i)
      for (uint32_t d = 0, rest = (i * 37) % count; d < dimensions; ++d, rest /= side)
        points.push_back((static_cast<float>(rest % side) + 0.5f) / static_cast<float>(side));
    const std::vector<uint32_t> order = sorted_by_keys<uint64_t>(context, curve, points, side);
    size_t jumps = 0;
    for (size_t k = 1; k < count; ++k) {
      float way = 0;
      for (size_t d = 0; d < dimensions; ++d)
        way += std::abs(points[order[k] * dimensions + d] - points[order[k - 1] * dimensions + d]);
      jumps += std::lround(way * static_cast<float>(side)) != 1;
    }
    CHECK(jumps == 0);
  }
}

TEST_CASE("faults of a user of CurveKeys: widths, boxes, buffers") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const auto made = [&](unsigned bits) {
    return message_of<kernels::Error>([&] { kernels::CurveKeys(context, kernels::Curve::hilbert2, bits); });
  };
  CHECK(contains(made(16), "keys of 16 bits"));
  kernels::CurveKeys keys_of(context, kernels::Curve::hilbert2);
  CHECK(keys_of.bits(1024) == 20);
  CHECK(keys_of.bits(1025) == 22);
  CHECK(keys_of.bits(1) == 0);
  const auto points = context.buffer<float>(8);
  const auto keys = context.buffer<uint32_t>(4);
  const auto wide = context.buffer<uint64_t>(4);
  const std::vector<float> lower{0, 0}, upper{1, 1};
  const auto message = [&](size_t n, uint64_t cells, size_t stride) {
    return message_of<kernels::Error>([&] { keys_of(points, n, {lower, upper, cells}, keys, stride); });
  };
  CHECK(contains(message(5, 2, 0), "CurveKeys: keys: the buffer has 16 bytes"));
  CHECK(contains(message(4, 65537, 0), "65537 cells"));
  CHECK(contains(message(4, 2, 1), "points of 1 floats"));
  CHECK(contains(message(4, 2, 3), "hold 8 floats"));
  CHECK(contains(message_of<kernels::Error>([&] { keys_of(points, 4, {upper, lower, 2}, keys); }), "from 1 to 0"));
  CHECK(contains(message_of<kernels::Error>([&] { keys_of(points, 4, {lower, upper, 2}, wide); }), "words of 64 bits"));
}
