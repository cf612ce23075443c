// SPDX-License-Identifier: Apache-2.0
// curves: bijections with unit steps at small orders, slow references at full width, the device against the host.
#include "passes/curves.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "passes/curve_references.hpp"
#include "passes/on_device.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

unsigned steps_between(const Point& a, const Point& b) {
  unsigned sum = 0;
  for (size_t d = 0; d < a.size(); ++d) sum += static_cast<unsigned>(std::abs(static_cast<int>(a[d] - b[d])));
  return sum;
}

}  // namespace

TEST_CASE("small orders: every cell has one code, and neighbours along a Hilbert curve differ by one step") {
  for (const HostCurve& curve : curves())
    for (unsigned level = 0; level * curve.dimensions <= 16; ++level) {
      CAPTURE(curve.name);
      CAPTURE(level);
      const uint64_t cells = uint64_t{1} << (level * curve.dimensions);
      size_t outside = 0, wrong = 0, jumps = 0;
      Point before{};
      for (uint64_t code = 0; code < cells; ++code) {
        const Point p = curve.decode(code, level);
        for (const uint32_t component : p) outside += component >> level != 0;
        // The inverse holds for all codes, and no cell is outside: so it is a bijection.
        wrong += curve.encode(p, level) != code;
        jumps += code > 0 && steps_between(p, before) != 1;
        before = p;
      }
      CHECK(outside == 0);
      CHECK(wrong == 0);
      if (curve.hilbert()) CHECK(jumps == 0);
    }
}

TEST_CASE("levels nest: a code without its last digit is the code of the cell above") {
  for (const HostCurve& curve : curves())
    for (unsigned level = 1; level <= curve.bits; ++level) {
      CAPTURE(curve.name);
      CAPTURE(level);
      size_t different = 0;
      for (const Point& p : points_of(curve, level, 50)) {
        Point above = p;
        for (uint32_t& component : above) component >>= 1;
        different += curve.encode(p, level) >> curve.dimensions != curve.encode(above, level - 1);
      }
      CHECK(different == 0);
    }
}

TEST_CASE("every level up to full width: the slow references, and back") {
  for (const HostCurve& curve : curves())
    for (unsigned level = 0; level <= curve.bits; ++level) {
      CAPTURE(curve.name);
      CAPTURE(level);
      size_t different = 0, lost = 0;
      for (const Point& p : points_of(curve, level, 200)) {
        const uint64_t code = curve.encode(p, level);
        different += code != curve.reference(p, level);
        lost += curve.decode(code, level) != p;
      }
      CHECK(different == 0);
      CHECK(lost == 0);
    }
}

TEST_CASE("published and hand-made vectors") {
  using namespace device;
  // J. Skilling, "Programming the Hilbert curve" (2004): his own check of five bits a component.
  CHECK(wt_hilbert3_encode(5, 10, 20, 5) == 7865);
  CHECK(wt_hilbert3_encode32(5, 10, 20, 5) == 7865);
  // The last cell of a Hilbert curve is at the far end of x.
  CHECK(wt_hilbert2_encode(0xFFFFFFFFu, 0, 32) == ~uint64_t{0});
  CHECK(wt_hilbert3_encode(0x1FFFFFu, 0, 0, 21) == ~uint64_t{0} >> 1);
  CHECK(wt_morton2_encode(0, 0xFFFFFFFFu) == 0xAAAAAAAAAAAAAAAAul);
  CHECK(wt_morton3_encode(0x1FFFFFu, 0, 0) == 0x1249249249249249ul);
  CHECK(wt_morton5_encode(0, 0, 0, 0, 0xFFF) == 0x0842108421084210ul);
}

TEST_CASE("each component counts, x too (the thesis' listing A.1 assigns the clamped z to x)") {
  for (const HostCurve& curve : curves())
    for (unsigned d = 0; d < curve.dimensions; ++d) {
      CAPTURE(curve.name);
      CAPTURE(d);
      Point p{3, 3, 3, 3, 3}, q;
      for (size_t unused = curve.dimensions; unused < p.size(); ++unused) p[unused] = 0;
      q = p;
      q[d] = 5;
      CHECK(curve.encode(p, 12) != curve.encode(q, 12));
      CHECK(curve.decode(curve.encode(q, 12), 12) == q);
    }
  CHECK(device::wt_morton3_encode(1, 0, 0) == 1);
  CHECK(device::wt_morton3_encode32(1, 0, 0) == 1);
  CHECK(device::wt_morton3_encode32(0, 0, 1) == 4);
}

TEST_CASE("32-bit codes are the 64-bit ones") {
  using namespace device;
  for (unsigned level = 0; level <= 16; ++level) {
    CAPTURE(level);
    size_t different = 0;
    for (const Point& p : points_of(curves()[0], level, 200)) {
      different += wt_morton2_encode32(p[0], p[1]) != wt_morton2_encode(p[0], p[1]);
      different += wt_hilbert2_encode32(p[0], p[1], level) != wt_hilbert2_encode(p[0], p[1], level);
    }
    for (const Point& p : points_of(curves()[1], std::min(level, 10u), 200)) {
      const unsigned level3 = std::min(level, 10u);
      different += wt_morton3_encode32(p[0], p[1], p[2]) != wt_morton3_encode(p[0], p[1], p[2]);
      different += wt_hilbert3_encode32(p[0], p[1], p[2], level3) != wt_hilbert3_encode(p[0], p[1], p[2], level3);
    }
    CHECK(different == 0);
  }
}

TEST_CASE("device codes and points are the host's, and nothing behind them is touched") {
  for (const uint32_t lanes : {1u, 16u})
    for (const HostCurve& curve : curves()) {
      Curve pass(context(), curve.name, lanes);
      REQUIRE(pass.dimensions() == curve.dimensions);
      REQUIRE(pass.bits() == curve.bits);
      for (const unsigned level : {0u, 1u, 7u, 12u})
        for (const uint32_t count : {0u, 1u, 15u, 16u, 17u, 1000u}) {
          CAPTURE(lanes);
          CAPTURE(curve.name);
          CAPTURE(level);
          CAPTURE(count);
          const unsigned bits = level == 0 ? curve.bits : level;
          const uint32_t stride = count + 3;
          const std::vector<Point> points = points_of(curve, bits, count);
          std::vector<uint32_t> planes(size_t{stride} * curve.dimensions, 7), untouched = planes;
          std::vector<uint64_t> expected(count + 3, 7);
          gpu::Buffer<uint64_t> codes = context().buffer(expected, "codes");
          for (uint32_t i = 0; i < count; ++i) {
            for (unsigned d = 0; d < curve.dimensions; ++d) planes[size_t{d} * stride + i] = points[i][d];
            expected[i] = curve.encode(points[i], bits);
          }
          pass.encode(context().buffer(planes, "points"), stride, count, codes, level);
          CHECK(codes.read() == expected);
          gpu::Buffer<uint32_t> decoded = context().buffer(untouched, "points");
          pass.decode(codes, count, decoded, stride, level);
          CHECK(decoded.read() == planes);
        }
    }
}

TEST_CASE("faults of the caller: unknown curves, levels too deep, buffers too small") {
  const auto message_of = [](const char* name) -> std::string {
    try {
      Curve curve(context(), name);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  CHECK(message_of("peano") == "curve \"peano\" is not known; there are morton2, morton3, morton5, hilbert2, hilbert3");
  CHECK_THROWS_AS(Curve(context(), "morton2", 8), std::invalid_argument);
  Curve curve(context(), "hilbert3");
  auto points = context().buffer<uint32_t>(30, "points");
  auto codes = context().buffer<uint64_t>(10, "codes");
  CHECK_NOTHROW(curve.decode(codes, 0, points, 0));
  CHECK_THROWS_AS(curve.encode(points, 10, 10, codes, 22), std::invalid_argument);
  CHECK_THROWS_AS(curve.encode(points, 10, 11, codes), std::invalid_argument);
  CHECK_THROWS_AS(curve.encode(points, 11, 10, codes), std::invalid_argument);
  CHECK_THROWS_AS(curve.decode(codes, 9, points, 11), std::invalid_argument);
}
