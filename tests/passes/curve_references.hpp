// SPDX-License-Identifier: Apache-2.0
// Slow references of the curves, and the functions of device/curves.h by one interface. References: bit loops (Morton),
// the grammar of the curve (Hilbert 2D), the motions of its octants (Hilbert 3D).
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "wavetracer/device/curves.h"

namespace wavetracer::test {

using Point = std::array<uint32_t, 5>;  // components past the curve's own are 0

struct HostCurve {
  std::string name;
  unsigned dimensions, bits;
  std::function<uint64_t(Point, unsigned)> encode;
  std::function<Point(uint64_t, unsigned)> decode;
  std::function<uint64_t(Point, unsigned)> reference;
  bool hilbert() const { return name.starts_with("hilbert"); }
};

inline uint64_t naive_morton(const Point& p, unsigned dimensions, unsigned bits) {
  uint64_t code = 0;
  for (unsigned bit = 0; bit < bits; ++bit)
    for (unsigned d = 0; d < dimensions; ++d) code |= uint64_t{p[d] >> bit & 1} << (bit * dimensions + d);
  return code;
}

// The grammar of the 2D curve (M. Bader, "Space-Filling Curves", Springer, 2013, section 3.1): the quadrants (x, y) of
// each of its four shapes, in order, and the shape inside.
inline uint64_t grammar_hilbert2(const Point& p, unsigned level) {
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
inline uint64_t motions_hilbert3(Point p, unsigned level) {
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

inline const std::vector<HostCurve>& curves() {
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
inline std::vector<Point> points_of(const HostCurve& curve, unsigned bits, size_t count) {
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

}  // namespace wavetracer::test
