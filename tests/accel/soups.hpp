// SPDX-License-Identifier: Apache-2.0
// Triangle soups for the tests of the acceleration structures: ordinary ones and those that break builders. Every
// function is deterministic, with the generator of the standard.
#pragma once
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "accel/triangles.hpp"

namespace wavetracer::test {

using Soup = std::vector<AccelTriangle>;

// Returns a uniform number in [0, 1) that is the same with every standard library.
class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  double operator()() { return static_cast<double>(engine_()) * 0x1p-32; }
  float between(double low, double high) { return static_cast<float>(low + (high - low) * (*this)()); }

 private:
  std::mt19937 engine_;
};

inline void add(Soup& soup, const float (&a)[3], const float (&b)[3], const float (&c)[3]) {
  const auto index = static_cast<uint32_t>(soup.size());
  soup.push_back({{{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, {c[0], c[1], c[2]}}, index, index / 2 + 7});
}

// Triangles of about `size` in a cube of side 2 * extent.
inline Soup random_soup(size_t count, double extent, double size, uint32_t seed) {
  Random random(seed);
  Soup soup;
  for (size_t i = 0; i < count; i++) {
    float v[3][3];
    const double center[3] = {random.between(-extent, extent), random.between(-extent, extent),
                              random.between(-extent, extent)};
    for (auto& vertex : v)
      for (int axis = 0; axis < 3; axis++) vertex[axis] = random.between(center[axis] - size, center[axis] + size);
    add(soup, v[0], v[1], v[2]);
  }
  return soup;
}

inline Soup identical_soup(size_t count) {
  Soup soup;
  for (size_t i = 0; i < count; i++) add(soup, {0, 0, 1}, {3, 0, 1}, {0, 4, 1});
  return soup;
}

// Long thin needles side by side along a diagonal: their boxes are mostly air and overlap one another.
inline Soup sliver_soup(size_t count, uint32_t seed) {
  Random random(seed);
  Soup soup;
  for (size_t i = 0; i < count; i++) {
    const float x = random.between(-100, 100), y = random.between(-100, 100), z = random.between(-100, 100);
    const float length = random.between(50, 100);
    add(soup, {x, y, z}, {x + length, y + length, z + length}, {x + length + 0.01f, y + length, z + length - 0.01f});
  }
  return soup;
}

// Makes needles through one point: many of them cross any plane.
inline Soup star_soup(size_t count, uint32_t seed) {
  Random random(seed);
  Soup soup;
  for (size_t i = 0; i < count; i++) {
    const float x = random.between(-100, 100), y = random.between(-100, 100), z = random.between(-100, 100);
    add(soup, {x, y, z}, {-x, -y, -z}, {-x + 0.01f, -y, -z + 0.01f});
  }
  return soup;
}

// Makes triangles, each half as large and half as far as the one before it, from 2^exponent m down: every binned split
// separates few from many.
inline Soup geometric_soup(size_t count, int exponent) {
  Soup soup;
  for (size_t i = 0; i < count; i++) {
    const float s = std::ldexp(1.0f, exponent - static_cast<int>(i));
    add(soup, {s, 0, 0}, {1.5f * s, 0.5f * s, 0}, {s, 0, 0.5f * s});
  }
  return soup;
}

// Streets of boxes on one large ground quad, axis-parallel walls of zero thickness in one direction.
inline Soup city_soup(int blocks, uint32_t seed) {
  Random random(seed);
  Soup soup;
  const auto quad = [&](const float(&a)[3], const float(&b)[3], const float(&c)[3], const float(&d)[3]) {
    add(soup, a, b, c);
    add(soup, a, c, d);
  };
  const float side = 30.0f * static_cast<float>(blocks);
  quad({-10, -10, 0}, {side, -10, 0}, {side, side, 0}, {-10, side, 0});
  for (int i = 0; i < blocks; i++)
    for (int j = 0; j < blocks; j++) {
      const float x0 = 30.0f * static_cast<float>(i), y0 = 30.0f * static_cast<float>(j);
      const float x1 = x0 + random.between(10, 20), y1 = y0 + random.between(10, 20), h = random.between(5, 40);
      quad({x0, y0, 0}, {x1, y0, 0}, {x1, y0, h}, {x0, y0, h});
      quad({x1, y0, 0}, {x1, y1, 0}, {x1, y1, h}, {x1, y0, h});
      quad({x1, y1, 0}, {x0, y1, 0}, {x0, y1, h}, {x1, y1, h});
      quad({x0, y1, 0}, {x0, y0, 0}, {x0, y0, h}, {x0, y1, h});
      quad({x0, y0, h}, {x1, y0, h}, {x1, y1, h}, {x0, y1, h});
    }
  return soup;
}

struct NamedSoup {
  std::string name;
  Soup soup;
  bool solid = true;  // there is something to hit
};

inline std::vector<NamedSoup> all_soups() {
  return {{"empty", {}, false},
          {"one", identical_soup(1)},
          {"two", random_soup(2, 10, 1, 1)},
          {"five", random_soup(5, 10, 1, 2)},
          {"10000 random", random_soup(10000, 100, 2, 3)},
          {"2000 identical", identical_soup(2000)},
          {"huge", random_soup(500, 1e38, 1e37, 4)},
          {"denormal", random_soup(500, 1e-39, 1e-40, 5)},
          {"points", random_soup(500, 1, 1e-40, 6), false},
          {"slivers", sliver_soup(400, 7)},
          {"star", star_soup(400, 7)},
          {"geometric", geometric_soup(30, 15)},
          {"city", city_soup(12, 8)}};
}

}  // namespace wavetracer::test
