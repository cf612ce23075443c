// SPDX-License-Identifier: Apache-2.0
// curves: bijections with unit steps at small orders, slow references at full width, the device against the host.
// References: bit loops (Morton), the grammar of the curve (Hilbert 2D), the motions of its octants (Hilbert 3D).
#include "kernels/curves.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "passes/on_device.hpp"
#include "wavetracer/device/curves.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Point = std::array<uint32_t, 5>;  // components past the curve's own are 0

struct HostCurve {
  std::string name;
  unsigned dimensions, bits;
  std::function<uint64_t(Point, unsigned)> encode;
  std::function<Point(uint64_t, unsigned)> decode;
  std::function<uint64_t(Point, unsigned)> reference;
  bool hilbert() const { return name.starts_with("hilbert"); }
};

uint64_t naive_morton(const Point& p, unsigned dimensions, unsigned bits) {
  uint64_t code = 0;
  for (unsigned bit = 0; bit < bits; ++bit)
    for (unsigned d = 0; d < dimensions; ++d) code |= uint64_t{p[d] >> bit & 1} << (bit * dimensions + d);
  return code;
}

// The grammar of the 2D curve (M. Bader, "Space-Filling Curves", Springer, 2013, section 3.1): the quadrants (x, y) of
// each of its four shapes, in order, and the shape inside.
uint64_t grammar_hilbert2(const Point& p, unsigned level) {
  struct Quadrant {
    uint32_t x, y;
    unsigned shape;
  };
  constexpr Quadrant shapes[4][4] = {{{0, 0, 1}, {0, 1, 0}, {1, 1, 0}, {1, 0, 2}},
                                     {{0, 0, 0}, {1, 0, 1}, {1, 1, 1}, {0, 1, 3}},
                                     {{1, 1, 3}, {0, 1, 2}, {0, 0, 2}, {1, 0, 0}},
                                     {{1, 1, 2}, {1, 0, 3}, {0, 0, 3}, {0, 1, 1}}};
  uint64_t code = 0;
  unsigned shape = 0;
  for (unsigned bit = level; bit-- > 0;) {
    unsigned digit = 0;
    while (shapes[shape][digit].x != (p[0] >> bit & 1) || shapes[shape][digit].y != (p[1] >> bit & 1)) ++digit;
    code = code * 4 + digit;
    shape = shapes[shape][digit].shape;
  }
  return code;
}

// The 3D curve by its octants: their order is the reflected Gray code of x, y, z, and the curve inside is the whole
// curve moved: component d of the whole curve's point is component axis[d] of the octant's, reversed where flip[d].
uint64_t motions_hilbert3(Point p, unsigned level) {
  struct Motion {
    std::array<unsigned, 3> axis;
    std::array<bool, 3> flip;
  };
  static const Motion motions[8] = {{{2, 0, 1}, {}},
                                    {{1, 0, 2}, {}},
                                    {{0, 1, 2}, {}},
                                    {{2, 1, 0}, {true, false, true}},
                                    {{2, 1, 0}, {}},
                                    {{0, 1, 2}, {}},
                                    {{1, 0, 2}, {true, true, false}},
                                    {{2, 0, 1}, {true, true, false}}};
  uint64_t code = 0;
  for (unsigned bit = level; bit-- > 0;) {
    const uint32_t octant = (p[0] >> bit & 1) << 2 | (p[1] >> bit & 1) << 1 | (p[2] >> bit & 1);
    unsigned digit = 0;
    while ((digit ^ digit >> 1) != octant) ++digit;
    code = code * 8 + digit;
    Point moved{};
    for (size_t d = 0; d < 3; ++d) moved[d] = p[motions[digit].axis[d]] ^ (motions[digit].flip[d] ? ~0u : 0u);
    p = moved;
  }
  return code;
}

const std::vector<HostCurve>& curves() {
  using namespace device;
  static const std::vector<HostCurve> all{
      {"morton2", 2, 32, [](Point p, unsigned) { return wt_morton2_encode(p[0], p[1]); },
       [](uint64_t code, unsigned) {
         Point p{};
         wt_morton2_decode(code, &p[0], &p[1]);
         return p;
       },
       [](Point p, unsigned) { return naive_morton(p, 2, 32); }},
      {"morton3", 3, 21, [](Point p, unsigned) { return wt_morton3_encode(p[0], p[1], p[2]); },
       [](uint64_t code, unsigned) {
         Point p{};
         wt_morton3_decode(code, &p[0], &p[1], &p[2]);
         return p;
       },
       [](Point p, unsigned) { return naive_morton(p, 3, 21); }},
      {"morton5", 5, 12, [](Point p, unsigned) { return wt_morton5_encode(p[0], p[1], p[2], p[3], p[4]); },
       [](uint64_t code, unsigned) {
         Point p{};
         wt_morton5_decode(code, &p[0], &p[1], &p[2], &p[3], &p[4]);
         return p;
       },
       [](Point p, unsigned) { return naive_morton(p, 5, 12); }},
      {"hilbert2", 2, 32, [](Point p, unsigned level) { return wt_hilbert2_encode(p[0], p[1], level); },
       [](uint64_t code, unsigned level) {
         Point p{};
         wt_hilbert2_decode(code, level, &p[0], &p[1]);
         return p;
       },
       grammar_hilbert2},
      {"hilbert3", 3, 21, [](Point p, unsigned level) { return wt_hilbert3_encode(p[0], p[1], p[2], level); },
       [](uint64_t code, unsigned level) {
         Point p{};
         wt_hilbert3_decode(code, level, &p[0], &p[1], &p[2]);
         return p;
       },
       motions_hilbert3}};
  return all;
}

// Pseudorandom points with `bits` bits a component (splitmix64's steps), then those of all zeros and all ones.
std::vector<Point> points_of(const HostCurve& curve, unsigned bits, size_t count) {
  const auto mask = static_cast<uint32_t>((uint64_t{1} << bits) - 1);
  std::vector<Point> points(count);
  uint64_t state = 1;
  for (Point& p : points)
    for (unsigned d = 0; d < curve.dimensions; ++d) {
      state += 0x9E3779B97F4A7C15ul;
      const uint64_t x = (state ^ state >> 30) * 0xBF58476D1CE4E5B9ul;
      p[d] = static_cast<uint32_t>(x >> 32) & mask;
    }
  points.push_back({});
  points.push_back({});
  for (unsigned d = 0; d < curve.dimensions; ++d) points.back()[d] = mask;
  return points;
}

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
