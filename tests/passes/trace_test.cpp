// SPDX-License-Identifier: Apache-2.0
// trace: every shape of traversal against a brute-force caster in double, and bit for bit against each other.
// Random soups and closed rooms; the hits of the blocks that compaction relies on.
#include "passes/trace.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "passes/caster.hpp"
#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Rays from inside and outside of a cube of half side `extent`.
std::vector<Ray> random_rays(size_t count, double extent, uint32_t seed) {
  Random random(seed);
  std::vector<Ray> rays;
  for (size_t i = 0; i < count; ++i) {
    const glm::dvec3 from = random.in_cube(extent * (i % 2 ? 2 : 1));
    rays.push_back(ray_towards(from, i % 4 ? random.in_cube(extent) - from : random.direction()));
  }
  return rays;
}

void check_against_caster(const Scene& scene, const std::vector<Ray>& rays, double position_error_m) {
  const DeviceScene uploaded = make_device_scene(context(), scene, false, reach_of(rays));
  const std::vector<AccelTriangle> triangles = accel_triangles(scene);
  std::vector<Hit> first;
  for (const TraceShape shape : shapes()) {
    CAPTURE(name_of(shape));
    const std::vector<Hit> hits = trace(uploaded, shape, rays);
    std::string wrong;  // error of the first ray whose hit is wrong
    for (size_t i = 0; i < rays.size() && wrong.empty(); ++i)
      wrong = fault(triangles, rays[i], hits[i], position_error_m);
    CHECK(wrong == "");
    if (first.empty()) first = hits;
    CHECK(hits == first);
  }
}

}  // namespace

TEST_CASE("random soups: the hits of a brute-force caster in double, in every shape") {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    check_against_caster(scene_of_triangles(random_soup(200, 10, 3, seed)), random_rays(150, 10, seed + 10), 2e-5);
  }
}

TEST_CASE("closed rooms: the hits of a brute-force caster, in every shape") {
  for (const Room shape : {Room::box, Room::ball}) {
    const std::vector<Corners> triangles = room(shape, 6, 10);
    check_against_caster(scene_of_triangles(triangles), aimed_rays(triangles, Aim::anywhere, 150, {0, 0, 0}, 4, 5),
                         2e-5);
  }
}

TEST_CASE("with and without spatial splits, hits are the same bit for bit") {
  const Scene scene = scene_of_triangles(random_soup(300, 10, 6, 4));
  const std::vector<Ray> rays = random_rays(200, 10, 5);
  const DeviceScene plain = make_device_scene(context(), scene, false, reach_of(rays)),
                    split = make_device_scene(context(), scene, true, reach_of(rays));
  for (const TraceShape shape : shapes()) CHECK(trace(plain, shape, rays) == trace(split, shape, rays));
}

TEST_CASE("a ray does not hit the surface that it leaves, and hits it from anywhere else") {
  const Scene scene =
      scene_of_triangles({{{{-5, -5, 0}, {5, -5, 0}, {0, 5, 0}}}, {{{-5, -5, 2}, {5, -5, 2}, {0, 5, 2}}}});
  const DeviceScene uploaded = make_device_scene(context(), scene, false);
  std::vector<Ray> rays(2, Ray{{0, 0, -1}, {0, 0, 1}});
  rays[1].surface = 0;
  for (const TraceShape shape : shapes()) {
    const std::vector<Hit> hits = trace(uploaded, shape, rays);
    CHECK(hits[0] == Hit{1, 0, 0});
    CHECK(hits[1] == Hit{3, 1, 1});
  }
}

TEST_CASE("every block counts its hits, in queues that end inside a block") {
  const std::vector<Corners> triangles{{{{-5, -5, 3}, {5, -5, 3}, {0, 5, 3}}}};
  const DeviceScene uploaded = make_device_scene(context(), scene_of_triangles(triangles), false);
  const uint32_t block = tuning_of(context().info()).block;
  for (const uint32_t count : {1u, 15u, 16u, 17u, 300u}) {
    CAPTURE(count);
    std::vector<Ray> rays(count);
    for (uint32_t i = 0; i < count; ++i) rays[i] = {{0, 0, 0}, {0, 0, i % 3 == 1 ? -1.0f : 1.0f}};
    std::vector<uint32_t> expected((count + block - 1) / block, 0);
    for (uint32_t i = 0; i < count; ++i) expected[i / block] += i % 3 != 1;
    for (const TraceShape shape : shapes()) {
      CAPTURE(name_of(shape));
      const RayQueue queue = upload(rays);
      HitList hits = make_hit_list(context(), count);
      Trace pass(context(), uploaded, shape);
      pass(uploaded, queue, hits);
      CHECK(hits.block_hits.read(0, expected.size()) == expected);
    }
  }
}

TEST_CASE("packets: lanes of all octants and axes in one block, and lanes that stand alone") {
  const std::vector<Corners> triangles = room(Room::ball, 4, 10);
  const Scene scene = scene_of_triangles(triangles);
  // Blocks of 16 with one, two, three and many directions of a class.
  std::vector<Ray> rays;
  Random random(9);
  for (int block = 0; block < 12; ++block) {
    const glm::dvec3 common = random.direction();
    for (int lane = 0; lane < 16; ++lane)
      rays.push_back(
          ray_towards(random.in_cube(2), lane < block ? random.direction() : common + 0.01 * random.direction()));
  }
  check_against_caster(scene, rays, 2e-5);
}
