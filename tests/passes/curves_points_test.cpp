// SPDX-License-Identifier: Apache-2.0
// curves: keys of points. Cells come from a search among the faces between the cells, codes from the slow references;
// points in the order of their Hilbert keys walk from cell to cell.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "passes/curve_references.hpp"
#include "passes/curves.hpp"
#include "passes/on_device.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Returns the last cell whose lower face is not above the component, in double: faces are where the box says. A cell of
// the next one or the one before is right, too, where float32 cannot tell them apart.
uint32_t cell_among_faces(float component, float lower, float upper, uint64_t cells) {
  const auto face = [&](uint64_t k) {
    return double{lower} + (double{upper} - double{lower}) * static_cast<double>(k) / static_cast<double>(cells);
  };
  uint64_t below = 0, above = cells;  // the face `below` is not above the component, the face `above` is, or is the end
  while (above - below > 1) {
    const uint64_t middle = (below + above) / 2;
    (face(middle) <= double{component} ? below : above) = middle;
  }
  return static_cast<uint32_t>(below);
}

struct TestBox {
  std::vector<float> lower{-3.0f, 10.0f, -0.5f, 0.0f, -64.0f}, upper{5.0f, 12.0f, 0.5f, 16.0f, 64.0f};
  CurveBox of(unsigned dimensions, uint64_t cells) const {
    return {std::span(lower).first(dimensions), std::span(upper).first(dimensions), cells};
  }
};

// Points of a box whose extents are powers of two, on a grid of 2^-12 of it, so that float32 knows every cell. Some lie
// on faces, some outside; the last three are NaN, far below, and far above in every dimension.
std::vector<float> grid_points(const TestBox& box, unsigned dimensions, unsigned stride, uint32_t count) {
  std::vector<float> points(size_t{stride} * count, std::numeric_limits<float>::quiet_NaN());
  uint64_t state = 7;
  for (uint32_t i = 0; i < count; ++i)
    for (unsigned d = 0; d < dimensions; ++d) {
      state = state * 6364136223846793005ul + 1442695040888963407ul;
      const auto step = static_cast<float>(static_cast<int>(state >> 48) % 5000 - 400);  // -400 .. 4599 of 4096
      float& component = points[size_t{i} * stride + d];
      component = box.lower[d] + (box.upper[d] - box.lower[d]) * step / 4096.0f;
      if (i + 3 == count) component = std::numeric_limits<float>::quiet_NaN();
      if (i + 2 == count) component = -std::numeric_limits<float>::infinity();
      if (i + 1 == count) component = 1e30f;
    }
  return points;
}

uint64_t key_of_point(const HostCurve& curve, const float* point, const TestBox& box, uint64_t cells) {
  Point cell{};
  for (unsigned d = 0; d < curve.dimensions; ++d)
    cell[d] = std::isnan(point[d]) ? 0 : cell_among_faces(point[d], box.lower[d], box.upper[d], cells);
  const unsigned level = PointKeys::level_of(cells);
  return curve.hilbert() || level < curve.bits ? curve.reference(cell, level) : curve.reference(cell, curve.bits);
}

template <class Key>
void check_keys(const HostCurve& curve, uint32_t lanes, uint64_t cells, unsigned spare, uint32_t count) {
  CAPTURE(curve.name);
  CAPTURE(lanes);
  CAPTURE(cells);
  CAPTURE(count);
  const TestBox box;
  const unsigned stride = curve.dimensions + spare;
  const std::vector<float> points = grid_points(box, curve.dimensions, stride, count);
  std::vector<Key> expected(count + 3, 7);
  gpu::Buffer<Key> keys = context().buffer(expected, "keys");
  for (uint32_t i = 0; i < count; ++i)
    expected[i] = static_cast<Key>(key_of_point(curve, points.data() + size_t{i} * stride, box, cells));
  PointKeys(context(), curve.name, sizeof(Key) * 8, lanes)(context().buffer(points, "points"), stride, count,
                                                           box.of(curve.dimensions, cells), keys);
  CHECK(keys.read() == expected);
}

}  // namespace

TEST_CASE("keys of points are the codes of their cells: 32 and 64 bits, histograms, points outside, NaN") {
  for (const uint32_t lanes : {1u, 16u})
    for (const HostCurve& curve : curves())
      for (const uint64_t cells : {1u, 2u, 7u, 32u, 64u}) {
        for (const uint32_t count : {0u, 1u, 15u, 16u, 17u, 500u}) check_keys<uint32_t>(curve, lanes, cells, 0, count);
        check_keys<uint64_t>(curve, lanes, cells, 1, 500);
        check_keys<uint64_t>(curve, lanes, cells == 64 ? 4096 : 100, 0, 500);
      }
}

TEST_CASE("cells at full width: faces of the box, and the finest cells that a key has") {
  for (const HostCurve& curve : curves())
    for (const uint32_t key_bits : {32u, 64u}) {
      CAPTURE(curve.name);
      CAPTURE(key_bits);
      const uint32_t bits = most_curve_bits(curve.name, key_bits);
      const uint64_t cells = uint64_t{1} << bits;
      const TestBox box;
      // A point a cell, or 2^-18 of the extent, below the upper face; the upper corner; the lower one.
      std::vector<float> points(3 * curve.dimensions);
      Point inner{}, last{};
      for (unsigned d = 0; d < curve.dimensions; ++d) {
        const float extent = box.upper[d] - box.lower[d];
        const unsigned fine = std::min(bits, 18u);
        points[d] = box.upper[d] - std::ldexp(extent, -static_cast<int>(fine));
        points[curve.dimensions + d] = box.upper[d];
        points[2 * curve.dimensions + d] = box.lower[d];
        inner[d] = static_cast<uint32_t>(cells - (cells >> fine));
        last[d] = static_cast<uint32_t>(cells - 1);
      }
      const std::vector<uint64_t> expected{curve.reference(inner, bits), curve.reference(last, bits), 0};
      const auto given = context().buffer(points, "points");
      PointKeys pass(context(), curve.name, key_bits);
      std::vector<uint64_t> found;
      if (key_bits == 32) {
        auto keys = context().buffer<uint32_t>(3, "keys");
        pass(given, curve.dimensions, 3, box.of(curve.dimensions, cells), keys);
        for (const uint32_t key : keys.read()) found.push_back(key);
      } else {
        auto keys = context().buffer<uint64_t>(3, "keys");
        pass(given, curve.dimensions, 3, box.of(curve.dimensions, cells), keys);
        found = keys.read();
      }
      CHECK(found == expected);
    }
}

TEST_CASE("points in the order of their Hilbert keys walk from a cell to its neighbour") {
  for (const auto& [name, cells] : {std::pair{"hilbert2", 32u}, {"hilbert3", 16u}}) {
    CAPTURE(name);
    const uint32_t dimensions = curve_dimensions(name);
    const uint32_t count = dimensions == 2 ? cells * cells : cells * cells * cells;
    std::vector<float> points;
    for (uint32_t i = 0; i < count; ++i)
      for (uint32_t d = 0, rest = i; d < dimensions; ++d, rest /= cells)
        points.push_back((static_cast<float>(rest % cells) + 0.5f) / static_cast<float>(cells));
    const std::vector<float> lower(dimensions, 0.0f), upper(dimensions, 1.0f);
    auto keys = context().buffer<uint32_t>(count, "keys");
    PointKeys(context(), name, 32)(context().buffer(points, "points"), dimensions, count, {lower, upper, cells}, keys);
    const std::vector<uint32_t> key_of = keys.read();
    std::vector<uint32_t> point_of(count, ~0u);
    for (uint32_t i = 0; i < count; ++i) {
      REQUIRE(key_of[i] < count);
      point_of[key_of[i]] = i;
    }
    size_t missing = 0, jumps = 0;
    for (uint32_t k = 0; k < count; ++k) missing += point_of[k] == ~0u;
    REQUIRE(missing == 0);
    for (uint32_t k = 1; k < count; ++k) {
      float steps = 0;
      for (uint32_t d = 0; d < dimensions; ++d)
        steps += std::fabs(points[point_of[k] * dimensions + d] - points[point_of[k - 1] * dimensions + d]);
      jumps += std::lround(steps * static_cast<float>(cells)) != 1;
    }
    CHECK(jumps == 0);
  }
}

TEST_CASE("faults of the caller of keys: boxes, cells, strides, widths") {
  PointKeys pass(context(), "hilbert3", 32);
  auto points = context().buffer<float>(30, "points");
  auto keys = context().buffer<uint32_t>(10, "keys");
  auto wide = context().buffer<uint64_t>(10, "wide keys");
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> zero(3, 0.0f), one(3, 1.0f), endless{1, infinity, 1}, unknown{nan, 0, 0};
  CHECK_NOTHROW(pass(points, 3, 10, {zero, one, 1024}, keys));
  CHECK_NOTHROW(pass(points, 3, 10, {zero, zero, 1024}, keys));
  CHECK(keys.read() == std::vector<uint32_t>(10, 0));
  CHECK_THROWS_AS(pass(points, 3, 10, {one, zero, 1024}, keys), std::invalid_argument);
  CHECK_THROWS_AS(pass(points, 3, 10, {zero, endless, 1024}, keys), std::invalid_argument);
  CHECK_THROWS_AS(pass(points, 3, 10, {unknown, one, 1024}, keys), std::invalid_argument);
  CHECK_THROWS_AS(pass(points, 3, 10, {std::span(zero).first(2), one, 1024}, keys), std::invalid_argument);
  CHECK_THROWS_AS(pass(points, 3, 10, {zero, one, 1025}, keys), std::invalid_argument);
  CHECK_THROWS_AS(pass(points, 3, 10, {zero, one, 0}, keys), std::invalid_argument);
  CHECK_THROWS_AS(pass(points, 2, 10, {zero, one, 2}, keys), std::invalid_argument);
  CHECK_THROWS_AS(pass(points, 3, 11, {zero, one, 2}, keys), std::invalid_argument);
  CHECK_THROWS_AS(pass(points, 3, 10, {zero, one, 2}, wide), std::invalid_argument);
  CHECK_THROWS_AS(PointKeys(context(), "hilbert3", 16), std::invalid_argument);
}
