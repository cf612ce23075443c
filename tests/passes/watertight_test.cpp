// SPDX-License-Identifier: Apache-2.0
// Leaks: rays inside closed rooms of 3,072 triangles, aimed at edges and vertices, also in UTM coordinates.
// A closed room has no way out, so every miss is a leak. A million rays are in large_device_test.cpp.
#include <doctest/doctest.h>

#include "passes/naive.hpp"
#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("no ray leaves a closed room through an edge or a vertex") {
  for (const Room shape : {Room::box, Room::ball}) {
    const std::vector<Corners> triangles = room(shape, 16, 7.3);
    REQUIRE(triangles.size() == 3072);
    const Scene scene = scene_of_triangles(triangles);
    const DeviceScene uploaded = make_device_scene(context(), scene, false);
    const NaiveTracer naive(scene);
    for (const Aim aim : {Aim::edges, Aim::vertices, Aim::anywhere}) {
      CAPTURE(static_cast<int>(aim));
      const std::vector<Ray> rays = aimed_rays(triangles, aim, 400, {0.1, -0.2, 0.3}, 1, 11);
      for (const TraceShape traversal : shapes()) {
        CAPTURE(name_of(traversal));
        CHECK(misses(trace(uploaded, traversal, rays)) == 0);
      }
      // The naive tracer, with more rays: edges leak less often than vertices.
      if (aim != Aim::anywhere) CHECK(misses(naive(aimed_rays(triangles, aim, 20000, {0.1, -0.2, 0.3}, 1, 11))) > 0);
    }
  }
}

TEST_CASE("UTM coordinates: recentred by the loader, so that nothing leaks") {
  const glm::dvec3 centre{691234.567, 5334765.432, 518.25};
  const std::vector<Corners> triangles = room(Room::ball, 16, 7.3, centre);
  const Scene scene = scene_by_loader(triangles);
  REQUIRE(scene.triangles.size() == 3072);
  const DeviceScene uploaded = make_device_scene(context(), scene, false);
  for (const Aim aim : {Aim::edges, Aim::vertices, Aim::anywhere}) {
    CAPTURE(static_cast<int>(aim));
    std::vector<Corners> recentred = triangles;
    for (Corners& corners : recentred)
      for (glm::dvec3& corner : corners) corner -= scene.origin_m;
    const std::vector<Ray> rays = aimed_rays(recentred, aim, 300, centre - scene.origin_m, 1, 12);
    for (const TraceShape traversal : shapes()) CHECK(misses(trace(uploaded, traversal, rays)) == 0);
    // Room and rays are the same in plain float32: the triangles are no longer where the rays are aimed.
    CHECK(misses(NaiveTracer(scene_of_triangles(triangles))(aimed_rays(triangles, aim, 20000, centre, 1, 12))) > 0);
  }
}

TEST_CASE("a small closed body seen from kilometres away has no holes") {
  // Edges that the rays pass through are seen from outside; the far side is closed as well, so none may miss.
  const std::vector<Corners> triangles = room(Room::ball, 8, 2);
  const Scene scene = scene_of_triangles(triangles);
  Random random(31);
  for (const double far : {100.0, 3000.0}) {
    CAPTURE(far);
    std::vector<Ray> rays;
    for (int i = 0; i < 300; ++i) {
      const Corners& triangle = triangles[random.below(static_cast<uint32_t>(triangles.size()))];
      const glm::dvec3 target = 0.9 * (triangle[0] + random() * (triangle[1] - triangle[0]));
      const glm::dvec3 from = far * random.direction();
      rays.push_back(ray_towards(from, target - from));
    }
    const DeviceScene uploaded = make_device_scene(context(), scene, false, reach_of(rays));
    for (const TraceShape traversal : shapes()) {
      CAPTURE(name_of(traversal));
      CHECK(misses(trace(uploaded, traversal, rays)) == 0);
    }
  }
}
