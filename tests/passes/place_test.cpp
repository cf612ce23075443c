// SPDX-License-Identifier: Apache-2.0
// place: instances against the same triangles baked into one scene, for every shape of traversal and for the exact half
// of a frame; absent instances; the antenna's own vehicle.
#include "passes/place.hpp"

#include <doctest/doctest.h>

#include "accel/instance_tree.hpp"
#include "passes/caster.hpp"
#include "passes/exact.hpp"
#include "passes/traffic.hpp"
#include "wavetracer/device/moving.h"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("rays hit instances as they hit the same triangles in one scene") {
  for (const size_t count : {1, 2, 3, 40}) {
    const Traffic traffic(count, 7);
    const Scene baked = traffic.baked();
    const std::vector<AccelTriangle> triangles = accel_triangles(baked);
    const std::vector<Ray> rays = rays_in(12, as_many(3000, 600), static_cast<uint32_t>(baked.surfaces.size()), 11);
    const DeviceScene uploaded = traffic.upload();
    const auto still = static_cast<uint32_t>(traffic.still.size());
    for (const TraceShape shape : shapes()) {
      CAPTURE(name_of(shape));
      const std::vector<Hit> hits = trace(uploaded, shape, rays);
      size_t moving = 0;
      for (size_t i = 0; i < rays.size(); ++i) {
        CHECK(fault(triangles, rays[i], hits[i], 2e-5) == "");
        moving += !hits[i].missed() && hits[i].surface >= still;
      }
      CHECK(moving > count * rays.size() / 300);  // otherwise the test would prove nothing
    }
  }
}

TEST_CASE("all shapes of traversal give the same bits") {
  const Traffic traffic(25, 3);
  const DeviceScene uploaded = traffic.upload();
  const std::vector<Ray> rays = rays_in(12, as_many(4000, 400), 500, 5);
  const std::vector<Hit> first = trace(uploaded, shapes().front(), rays);
  for (const TraceShape shape : shapes()) CHECK(trace(uploaded, shape, rays) == first);
}

TEST_CASE("an absent instance is hit by nothing and reflects nothing") {
  Traffic traffic(2, 19);
  traffic.placements[0].present = false;
  const DeviceScene uploaded = traffic.upload();
  const uint32_t first = traffic.instances[0].first_surface, second = traffic.instances[1].first_surface;
  const std::vector<Ray> rays = rays_in(12, as_many(4000, 800), 1, 23);
  for (const TraceShape shape : shapes()) {
    size_t absent = 0, present = 0;
    for (const Hit& hit : trace(uploaded, shape, rays)) {
      if (hit.missed()) continue;
      absent += hit.surface >= first && hit.surface < second;
      present += hit.surface >= second;
    }
    CHECK(absent == 0);
    CHECK(present > 0);
  }
  const auto exact = uploaded.exact_surfaces.read();
  CHECK(std::isnan(exact[first].normal[0]));
  CHECK_FALSE(std::isnan(exact[second].normal[0]));
}

TEST_CASE("launch rays pass through their own vehicle and nothing else") {
  Traffic traffic(2, 29);
  traffic.placements[1].position_m = traffic.placements[0].position_m;  // one inside the other
  const DeviceScene uploaded = traffic.upload();
  const uint32_t first = traffic.instances[0].first_surface, second = traffic.instances[1].first_surface;
  Random random(31);
  std::vector<Ray> rays(as_many(2000, 300));
  for (Ray& ray : rays) {
    const glm::dvec3 d = random.direction();
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[static_cast<size_t>(axis)] = static_cast<float>(traffic.placements[0].position_m[axis]);
      ray.direction[static_cast<size_t>(axis)] = static_cast<float>(d[axis]);
    }
    ray.surface = WT_OWN | 0;
  }
  for (const TraceShape shape : shapes()) {
    size_t own = 0, other = 0;
    for (const Hit& hit : trace(uploaded, shape, rays)) {
      if (hit.missed()) continue;
      own += hit.surface >= first && hit.surface < second;
      other += hit.surface >= second;
    }
    CHECK(own == 0);
    CHECK(other > 100);
  }
}

TEST_CASE("paths by instances are those of the baked scene, to rounding") {
  const Traffic traffic(12, 41);
  const Scene baked = traffic.baked();
  Random random(43);
  std::vector<glm::dvec3> transmitters, receivers;
  for (int i = 0; i < 2; ++i) transmitters.push_back(random.in_cube(10));
  for (uint32_t i = 0; i < as_many(160, 110); ++i) receivers.push_back(random.in_cube(10));
  std::vector<Sequence> sequences;
  for (uint32_t tx = 0; tx < 2; ++tx)
    for (uint32_t a = 0; a < baked.surfaces.size(); ++a) {
      sequences.push_back({tx, {a}});
      for (int k = 0; k < 3; ++k) {
        const uint32_t b = random.below(static_cast<uint32_t>(baked.surfaces.size()));
        if (a != b) sequences.push_back({tx, {a, b}});
      }
    }
  const Exact one(baked, transmitters, receivers, sequences, 2);
  const Exact two(scene_of_triangles(traffic.still), transmitters, receivers, sequences, 2, [&](DeviceScene& scene) {
    PlacedScene placed = with_instances(context(), std::move(scene), scene_of_triangles(traffic.still), traffic.models,
                                        traffic.instances);
    placed.place(placed.scene, traffic.placements);
    scene = std::move(placed.scene);
  });
  REQUIRE(one.solved.size() == two.solved.size());
  CHECK(one.solved.size() > 200);
  size_t moving = 0;
  for (size_t i = 0; i < one.solved.size(); ++i) {
    const SolvedPath &a = one.solved[i], &b = two.solved[i];
    CHECK(a.sequence == b.sequence);
    CHECK(a.receiver == b.receiver);
    CHECK(a.blocked == b.blocked);
    for (size_t k = 0; k < a.points.size(); ++k) CHECK(glm::length(a.points[k] - b.points[k]) < 1e-9);
    for (const uint32_t surface : a.sequence.surfaces) moving += surface >= traffic.still.size();
  }
  CHECK(moving > 50);
}

TEST_CASE("the top level holds every box once, in a tree no deeper than it need be") {
  for (const size_t count : {0, 1, 2, 3, 17, 1000}) {
    Random random(static_cast<uint32_t>(count));
    std::vector<Box> boxes(count);
    for (Box& box : boxes)
      for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = static_cast<float>(random.between(-50, 50));
        box.upper[axis] = box.lower[axis] + static_cast<float>(random.between(0, 5));
      }
    const TopLevel top = build_top_level(boxes);
    std::vector<uint32_t> sorted = top.order;
    std::sort(sorted.begin(), sorted.end());
    for (uint32_t i = 0; i < count; ++i) CHECK(sorted[i] == i);
    CHECK(top.nodes.size() == std::max<size_t>(count < 2 ? 1 : count - 1, 1));
  }
}
