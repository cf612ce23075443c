// SPDX-License-Identifier: Apache-2.0
// Meshes of cells over a height, with rounding and noise, for the tests of flat surfaces.
#pragma once
#include <cmath>
#include <functional>
#include <random>

#include "wedge_check.hpp"

namespace wavetracer::test {

constexpr double cells_tolerance_m = 1.6e-3;
using Height = std::function<double(double, double)>;

inline double rounded(double x, int decimals) {
  const double steps = std::pow(10, decimals);
  return std::round(x * steps) / steps;
}

struct Cells {
  int along = 60, across = 8;
  double length_m = 1, width_m = 1.5;
  int decimals = 9;
  double noise_m = 0;
  unsigned seed = 1;
};

// Cells over z = height(x, y), two triangles each, with diagonals in both directions.
inline RawMesh cells(const Cells& c, const Height& height, const dvec3& corner = dvec3(0)) {
  std::mt19937 random(c.seed);
  std::normal_distribution<double> noise(0, 1);
  RawMesh out = mesh({}, {});
  for (int i = 0; i <= c.along; ++i) {
    for (int j = 0; j <= c.across; ++j) {
      const double x = corner.x + i * c.length_m, y = corner.y + j * c.width_m;
      const double z = corner.z + height(x, y) + c.noise_m * noise(random);
      out.vertices.emplace_back(rounded(x, c.decimals), rounded(y, c.decimals), rounded(z, c.decimals));
    }
  }
  const auto number = [&](int i, int j) { return static_cast<uint32_t>(i * (c.across + 1) + j); };
  for (int i = 0; i < c.along; ++i) {
    for (int j = 0; j < c.across; ++j) {
      const uint32_t a = number(i, j), b = number(i + 1, j), d = number(i + 1, j + 1), e = number(i, j + 1);
      if ((i + j) % 3 == 0) {
        out.triangles.push_back({a, b, e});
        out.triangles.push_back({b, d, e});
      } else {
        out.triangles.push_back({a, b, d});
        out.triangles.push_back({a, d, e});
      }
    }
  }
  return out;
}

inline const Height road = [](double x, double y) { return 0.021347 * x + 0.024719 * y; };

// The largest distance of a corner of a scene from the plane of its surface.
inline double off_plane_m(const Scene& s) {
  double out_m = 0;
  for (uint32_t t = 0; t < s.triangles.size(); ++t) {
    const Surface& f = s.surfaces[s.triangle_surface[t]];
    for (const uint32_t v : s.triangles[t])
      out_m = std::max(out_m, std::abs(glm::dot(f.normal, s.vertices[v]) - f.offset_m));
  }
  return out_m;
}

}  // namespace wavetracer::test
