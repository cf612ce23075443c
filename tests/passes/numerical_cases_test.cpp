// SPDX-License-Identifier: Apache-2.0
// The numerical cases of ray traversal, each on rays that make the naive tracer of naive.hpp fail.
// Leaks at edges and vertices are in watertight_test.cpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "passes/caster.hpp"
#include "passes/naive.hpp"
#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Two triangles; corner, corner + u, corner + u + v, corner + v.
void add_quad(std::vector<Corners>& triangles, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
  triangles.push_back({corner, corner + u, corner + u + v});
  triangles.push_back({corner, corner + u + v, corner + v});
}

// Returns hits in every shape, which must agree.
std::vector<Hit> hits_of(const Scene& scene, const std::vector<Ray>& rays, bool spatial_splits = false) {
  const DeviceScene uploaded = make_device_scene(context(), scene, spatial_splits, reach_of(rays));
  const std::vector<Hit> first = trace(uploaded, shapes()[0], rays);
  for (const TraceShape shape : shapes()) {
    CAPTURE(name_of(shape));
    CHECK(trace(uploaded, shape, rays) == first);
  }
  return first;
}

}  // namespace

TEST_CASE("axis-parallel rays in the planes of boxes: zeros of both signs") {
  // Every plane x, y, z = k / 2 is a plane of some node's box: rays that run in it meet 0 * infinity in a naive slab.
  const std::vector<Corners> triangles = room(Room::box, 4, 1);
  const Scene scene = scene_of_triangles(triangles);
  std::vector<Ray> rays;
  for (size_t axis = 0; axis < 3; ++axis)
    for (const float along : {-1.0f, 1.0f})
      for (const float zero : {0.0f, -0.0f})
        for (const float a : {-1.0f, -0.5f, 0.0f, 0.5f, 1.0f})
          for (const float b : {-0.5f, 0.0f, 0.3f}) {
            Ray ray;
            ray.direction = {zero, zero, zero};
            ray.direction[axis] = along;
            ray.origin[(axis + 1) % 3] = a;
            ray.origin[(axis + 2) % 3] = b;
            rays.push_back(ray);
          }
  const std::vector<Hit> hits = hits_of(scene, rays);
  CHECK(misses(hits) == 0);
  for (size_t i = 0; i < rays.size(); ++i) CHECK(hits[i].t == 1.0f);
  CHECK(misses(NaiveTracer(scene)(rays)) > 0);
}

TEST_CASE("directions with one zero or nearly zero component") {
  const std::vector<Corners> triangles = room(Room::box, 4, 1);
  const Scene scene = scene_of_triangles(triangles);
  Random random(3);
  std::vector<Ray> rays;
  for (const float small : {0.0f, -0.0f, 1e-42f, -1e-38f, 1e-20f, 1e-9f})
    for (size_t axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 8; ++i) {
        Ray ray = ray_towards({0, 0, 0}, random.direction());
        ray.direction[axis] = small;
        ray.origin[axis] = static_cast<float>(2 * i - 7) / 8;
        rays.push_back(ray);
      }
  CHECK(misses(hits_of(scene, rays)) == 0);
  CHECK(misses(NaiveTracer(scene)(rays)) > 0);
}

TEST_CASE("coplanar overlaps: the lowest primitive wins, whatever the tree") {
  // The same wall is repeated many times, shifted by whole cells: nearly every ray meets several triangles at one
  // distance.
  std::vector<Corners> triangles;
  Random random(8);
  for (int i = 0; i < 40; ++i)
    add_quad(triangles, {5, -8.0 + random.below(8), -8.0 + random.below(8)}, {0, 8, 0}, {0, 0, 8});
  const Scene scene = scene_of_triangles(triangles);
  std::vector<Ray> rays;
  for (int i = 0; i < 200; ++i)
    rays.push_back(ray_towards({0, 0, 0}, {5, random.between(-3, 3), random.between(-3, 3)}));
  const std::vector<AccelTriangle> flat = accel_triangles(scene);
  const std::vector<Hit> hits = hits_of(scene, rays), split = hits_of(scene, rays, true);
  CHECK(hits == split);
  // The distance of the lowest primitive among all that the ray passes well inside of.
  size_t ties = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    uint32_t lowest = WT_NONE;
    for (const AccelTriangle& triangle : flat)
      if (meet(triangle, rays[i], 1e-5).inside_m > 1e-4) lowest = std::min(lowest, triangle.primitive);
    if (lowest == WT_NONE) continue;
    // A triangle may round to a distance that is one unit shorter; if not, the lowest must win.
    if (hits[i].primitive != lowest) {
      CHECK(hits[i].t < meet(flat[lowest], rays[i], 1e-5).t * (1 + 1e-7));
    } else {
      ++ties;
    }
  }
  CHECK(ties > 20);
  // The naive tracer's answers are those of its tree.
  CHECK(NaiveTracer(scene, 1)(rays) != NaiveTracer(scene, 8)(rays));
}

TEST_CASE("exact ties: a wall that is there twice is hit once, at its lower index") {
  std::vector<Corners> triangles;
  for (int i = 0; i < 6; ++i) add_quad(triangles, {4, -4, -4}, {0, 8, 0}, {0, 0, 8});
  std::reverse(triangles.begin(), triangles.end());
  const Scene scene = scene_of_triangles(triangles);
  Random random(12);
  std::vector<Ray> rays;
  for (int i = 0; i < 100; ++i)
    rays.push_back(ray_towards({0, 0, 0}, {4, random.between(-3, 3), random.between(-3, 3)}));
  const std::vector<Hit> hits = hits_of(scene, rays);
  for (const Hit& hit : hits) CHECK(hit.primitive <= 1);
  const std::vector<Hit> naive = NaiveTracer(scene)(rays);
  CHECK(std::any_of(naive.begin(), naive.end(), [](const Hit& hit) { return hit.primitive > 1; }));
}

TEST_CASE("needles: a wall of 400 slivers of 0.5 mm has no gaps") {
  // Neighbours share their long edges, which run askew.
  std::vector<Corners> triangles;
  const auto point = [](int i, int end) {
    return glm::dvec3{10, -50.0 + 100 * end + 0.001 * i, -0.05 + 0.0005 * i + 0.03 * end};
  };
  for (int i = 0; i < 200; ++i) {
    triangles.push_back({point(i, 0), point(i, 1), point(i + 1, 1)});
    triangles.push_back({point(i, 0), point(i + 1, 1), point(i + 1, 0)});
  }
  const Scene scene = scene_of_triangles(triangles);
  Random random(4);
  std::vector<Ray> rays;
  for (int i = 0; i < 600; ++i) {
    const double part = random.between(0.05, 0.95), along = random.between(0.05, 0.95) * 200;
    const int needle = static_cast<int>(along);
    const glm::dvec3 on_edge = point(needle, 0) + part * (point(needle, 1) - point(needle, 0));
    const glm::dvec3 from{0, random.between(-5, 5), random.between(-0.01, 0.01)};
    rays.push_back(ray_towards(from, on_edge - from));
  }
  CHECK(misses(NaiveTracer(scene)(rays)) > 0);
  rays.resize(as_many(600, 60));
  CHECK(misses(hits_of(scene, rays)) == 0);
}

TEST_CASE("a ground of 10 km in two triangles: no gap on its diagonal, distances to float32") {
  std::vector<Corners> triangles;
  add_quad(triangles, {-5000.3, -4999.6, 0.1}, {10000.7, 0, 0}, {0, 10000.1, 0});
  const Scene scene = scene_of_triangles(triangles);
  Random random(6);
  std::vector<Ray> rays;
  for (int i = 0; i < 600; ++i) {
    const glm::dvec3 from{random.between(-100, 100), random.between(-100, 100), random.between(1.5, 30)};
    const double part = random.between(0.02, 0.98);
    const glm::dvec3 diagonal = triangles[0][0] + part * (triangles[0][2] - triangles[0][0]);
    rays.push_back(ray_towards(from, diagonal - from));
  }
  const std::vector<Hit> hits = hits_of(scene, rays);
  CHECK(misses(hits) == 0);
  double worst = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    const double exact = (static_cast<double>(0.1f) - rays[i].origin[2]) / rays[i].direction[2];
    worst = std::max(worst, std::abs(hits[i].t - exact) * -rays[i].direction[2]);  // height above the ground
  }
  CHECK(worst < 1e-3);
  CHECK(misses(NaiveTracer(scene)(rays)) > 0);
}

TEST_CASE("grazing rays: a rough floor seen at one part in a hundred thousand") {
  // A closed strip: floor and ceiling of 40 x 4 cells 1 mm apart, and rays between them nearly parallel to both.
  std::vector<Corners> triangles;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 4; ++j)
      for (const double z : {0.0, 0.001}) add_quad(triangles, {i * 2.5, j * 2.5 - 5, z}, {2.5, 0, 0}, {0, 2.5, 0});
  add_quad(triangles, {100, -5, -1}, {0, 10, 0}, {0, 0, 2});
  const Scene scene = scene_of_triangles(triangles);
  Random random(7);
  std::vector<Ray> rays;
  for (int i = 0; i < 400; ++i)
    rays.push_back(ray_towards({0.01, random.between(-4, 4), 0.0005}, {100, 0, random.between(-0.05, 0.05)}));
  const std::vector<Hit> hits = hits_of(scene, rays);
  CHECK(misses(hits) == 0);
  for (size_t i = 0; i < rays.size(); ++i) {
    const double z = double{rays[i].origin[2]} + double{hits[i].t} * rays[i].direction[2];
    CHECK(z > -1e-5);
    CHECK(z < 0.001 + 1e-5);
  }
  CHECK(misses(NaiveTracer(scene)(rays)) > 0);
}

TEST_CASE("triangles that shrink a thousandfold and more: a deep tree, and nothing lost") {
  // Each half as large and half as far as the one before it, so every split separates few from many; rays come along
  // their line, from both ends, and from above.
  std::vector<Corners> triangles;
  for (int i = 0; i < 40; ++i) {
    const double s = std::ldexp(1.0, 12 - i);
    triangles.push_back({glm::dvec3{s, -s, -s}, {s, 2 * s, -s}, {s, -s, 2 * s}});
  }
  const Scene scene = scene_of_triangles(triangles);
  std::vector<Ray> rays;
  std::vector<uint32_t> expected;
  for (uint32_t i = 0; i + 1 < triangles.size(); ++i) {
    const auto x = static_cast<float>(std::ldexp(1.0, 11 - static_cast<int>(i)) * 1.25);
    rays.push_back({{x, 0, 0}, {1, 0, 0}});  // between triangles i + 1 and i
    expected.push_back(i);
    rays.push_back({{x, 0, 0}, {-1, 0, 0}});
    expected.push_back(i + 1);
  }
  const std::vector<Hit> hits = hits_of(scene, rays);
  for (size_t i = 0; i < rays.size(); ++i) CHECK(hits[i].primitive == expected[i]);
  const std::vector<Hit> naive = NaiveTracer(scene)(rays);
  size_t wrong = 0;
  for (size_t i = 0; i < rays.size(); ++i) wrong += naive[i].primitive != expected[i];
  CHECK(wrong > 0);
}

TEST_CASE("small triangles down to what loading keeps are hit, and those of denormal size hide nothing") {
  for (const double size : {1e-2, 1e-4, 1e-6, 1e-15}) {
    CAPTURE(size);
    const Scene scene = scene_of_triangles({{{{0, -size, -size}, {0, 2 * size, -size}, {0, -size, 2 * size}}}});
    const std::vector<Ray> rays{{{-1, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {-1, 0, 0}}};
    CHECK(hits_of(scene, rays) == std::vector<Hit>(2, Hit{1, 0, 0}));
    if (size < 1e-5) CHECK(misses(NaiveTracer(scene)(rays)) == 2);
  }
  std::vector<Corners> triangles = random_soup(100, 1e-39, 1e-40, 5);
  add_quad(triangles, {1, -1, -1}, {0, 2, 0}, {0, 0, 2});
  Random random(2);
  std::vector<Ray> rays;
  for (int i = 0; i < 64; ++i)
    rays.push_back(ray_towards({-1, 0, 0}, {2, random.between(-0.9, 0.9), random.between(-0.9, 0.9)}));
  rays.push_back({{-1, 0, 0}, {1, 0, 0}});
  CHECK(misses(hits_of(scene_of_triangles(triangles), rays)) == 0);
}

TEST_CASE("a single triangle is hit from both sides and missed beside it; an empty scene is missed") {
  const std::vector<Ray> rays{
      {{0, 0, 1}, {0, 0, -1}}, {{0, 0, -3}, {0, 0, 1}}, {{5, 0, 1}, {0, 0, -1}}, {{0, 0, 1}, {0, 0, 1}}};
  const Scene one = scene_of_triangles({{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}}});
  CHECK(hits_of(one, rays) == std::vector<Hit>{{1, 0, 0}, {3, 0, 0}, {}, {}});
  CHECK(misses(hits_of(Scene{}, rays)) == rays.size());
}

TEST_CASE("five triangles: what fills up a block of four is never hit") {
  // Lanes filled with zeros would be a triangle at the origin.
  std::vector<Corners> triangles;
  for (int i = 0; i < 5; ++i) triangles.push_back({glm::dvec3{10.0 + i, 0, 0}, {11.0 + i, 0, 0}, {10.0 + i, 1, 0}});
  std::vector<Ray> rays;
  for (int i = 0; i < 5; ++i) rays.push_back({{10.25f + static_cast<float>(i), 0.25f, 2}, {0, 0, -1}});
  rays.push_back({{0, 0, 2}, {0, 0, -1}});
  rays.push_back(ray_towards({1, 2, 2}, {-1, -2, -2}));
  const std::vector<Hit> hits = hits_of(scene_of_triangles(triangles), rays);
  for (uint32_t i = 0; i < 5; ++i) CHECK(hits[i] == Hit{2, i, i});
  CHECK(hits[5].missed());
  CHECK(hits[6].missed());
}

TEST_CASE("rays whose slabs overflow float32 end, and change nothing for the rays beside them") {
  // A hundred triangles leave children of nodes unused, whose boxes such rays meet like others.
  const Scene scene = scene_of_triangles(random_soup(100, 1, 0.2, 7));
  constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const Ray sane = ray_towards({-3, 0.1, 0.2}, {1, 0.02, -0.05});
  std::vector<Ray> rays;
  for (const float far : {1e27f, -1e30f, 3e38f, infinity, -infinity, nan})
    for (size_t axis = 0; axis < 3; ++axis)
      for (const Float3 direction : {Float3{1, 0, 0}, {-0.6f, 0.8f, 0}, {nan, 0, 1}, {infinity, 1, 0}}) {
        Ray ray{{0, 0, 0}, direction};
        ray.origin[axis] = far;
        rays.push_back(ray);
        rays.push_back(sane);
      }
  // Some trees are built for such places, as far as a caller may ask for them, and some are not.
  for (const double reach_m : {3.0, 1e27}) {
    const DeviceScene uploaded = make_device_scene(context(), scene, false, reach_m);
    for (const TraceShape shape : shapes()) {
      CAPTURE(name_of(shape));
      const Hit alone = trace(uploaded, shape, {sane})[0];
      const std::vector<Hit> hits = trace(uploaded, shape, rays);
      for (size_t i = 1; i < rays.size(); i += 2) CHECK(hits[i] == alone);
    }
  }
}
