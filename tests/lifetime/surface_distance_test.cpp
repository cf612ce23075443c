// SPDX-License-Identifier: Apache-2.0
// Distances from lines to triangles, compared with those of many points of both, and the tree with a loop over all
// triangles.
#include "lifetime/surface_distance.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "lifetime/surface_border.hpp"
#include "reference/quads.hpp"

using namespace wavetracer;

namespace {

// Points in cubes.
class Places {
 public:
  explicit Places(uint32_t seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * 0x1p-32 * static_cast<double>(engine_()); }
  glm::dvec3 in_cube(double half) {
    const double x = between(-half, half), y = between(-half, half);
    return {x, y, between(-half, half)};
  }

 private:
  std::mt19937 engine_;
};

using Triangle = std::array<glm::dvec3, 3>;

// The least distance between points of both; the true one is smaller by no more than the steps between them.
double by_points(const Segment& s, const Triangle& t, int count) {
  double least = 1e300;
  for (int i = 0; i <= count; ++i)
    for (int j = 0; i + j <= count; ++j) {
      const double u = i / double(count), v = j / double(count);
      least = std::min(least, distance_m(t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]), s));
    }
  return least;
}

}  // namespace

TEST_CASE("the distance from a line to a triangle is the least one between their points") {
  Places random(1);
  int meet = 0;
  for (int k = 0; k < 400; ++k) {
    CAPTURE(k);
    const Triangle t{random.in_cube(2), random.in_cube(2), random.in_cube(2)};
    const Segment s{random.in_cube(3), random.in_cube(3)};
    const double least = by_points(s, t, 60), found = distance_m(s, t);
    const double step = std::max(glm::distance(t[0], t[1]), glm::distance(t[0], t[2])) / 60;
    CHECK(found <= least + 1e-12);
    CHECK(found >= least - 1.5 * step);
    meet += found == 0;
  }
  CHECK(meet > 20);
}

TEST_CASE("distances of lines that are parallel, have no length, or touch") {
  CHECK(distance_m(Segment{{0, 0, 0}, {4, 0, 0}}, Segment{{1, 3, 0}, {9, 3, 0}}) == doctest::Approx(3));
  CHECK(distance_m(Segment{{0, 0, 0}, {4, 0, 0}}, Segment{{7, 4, 0}, {9, 4, 0}}) == doctest::Approx(5));
  CHECK(distance_m(Segment{{1, 1, 2}, {1, 1, 2}}, Triangle{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}) == doctest::Approx(2));
  CHECK(distance_m(Segment{{1, 1, 0}, {1, 1, 2}}, Triangle{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}) == doctest::Approx(0));
}

TEST_CASE("the tree finds the nearest surface that is not left out, as a loop does") {
  Places random(2);
  std::vector<reference::Quad> quads;
  for (int k = 0; k < 150; ++k) quads.push_back({random.in_cube(20), random.in_cube(4), random.in_cube(4)});
  const Scene scene = reference::scene_of_quads(quads);
  const SurfaceDistance tree(scene);
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    const Segment s{random.in_cube(20), random.in_cube(20)};
    const uint32_t modulus = 2 + static_cast<uint32_t>(random.between(0, 8));
    const auto leaves_out = [&](uint32_t surface) { return surface % modulus == 0; };
    double least = 3;
    for (size_t t = 0; t < scene.triangles.size(); ++t) {
      const auto& [a, b, c] = scene.triangles[t];
      if (!leaves_out(scene.triangle_surface[t]))
        least = std::min(least, distance_m(s, Triangle{scene.vertices[a], scene.vertices[b], scene.vertices[c]}));
    }
    CHECK(tree(s, 3, leaves_out) == least);
  }
}

TEST_CASE("the border of a surface is where no triangle of it goes on") {
  const Scene scene = reference::scene_of_quads({{{0, 0, 0}, {10, 0, 0}, {0, 4, 0}}});
  const SurfaceBorders borders(scene);
  CHECK(borders.margin_m(0, {5, 2, 0}) == doctest::Approx(2));
  CHECK(borders.margin_m(0, {9.5, 2, 0}) == doctest::Approx(0.5));
  CHECK(borders.margin_m(0, {5, 3.9, 0}) == doctest::Approx(0.1));
}
