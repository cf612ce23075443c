// SPDX-License-Identifier: Apache-2.0
// Cases with too many work-items for Oclgrind: a million rays at edges and vertices, a million bounces, long lists. The
// small cases are in the files named after the passes.
#include <doctest/doctest.h>

#include "passes/image_method.hpp"
#include "passes/naive.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Rays that bounce until the last has flown out, or `bounces` times.
struct Bounces {
  uint64_t segments = 0, escaped = 0, back_to_the_same = 0;
  std::vector<Ray> last;

  Bounces(const Scene& scene, std::vector<Ray> rays, uint32_t bounces) {
    const DeviceScene uploaded = make_device_scene(context(), scene, false);
    RayQueue queue = upload(rays), next = upload(rays);
    HitList hits = make_hit_list(context(), rays.size());
    Sequences set(context(), 1 << 22);
    Trace trace_pass(context(), uploaded, shapes()[shapes().size() / 2]);
    Scan scan(context());
    Interact interact(context());
    for (uint32_t k = 0; k < bounces; ++k) {
      trace_pass(uploaded, queue, hits);
      const uint32_t alive = scan(hits.block_hits, hits.blocks(queue.count));
      segments += queue.count;
      escaped += queue.count - alive;
      interact(uploaded, queue, hits, alive, set.trie(), {.reflected = &next});
      std::swap(queue, next);
    }
    last = download(queue);
    CHECK_FALSE(set.overflowed());
  }
};

// The naive tracer does the same: it mirrors at o + t d without regard to the side, as first attempts do.
uint64_t naive_escapes(const Scene& scene, std::vector<Ray> rays, uint32_t bounces) {
  const NaiveTracer tracer(scene);
  uint64_t escaped = 0;
  for (Ray& ray : rays)
    for (uint32_t k = 0; k < bounces; ++k) {
      const Hit hit = tracer(ray);
      if (hit.missed()) {
        ++escaped;
        break;
      }
      const Float3 n = to_float(scene.surfaces[hit.surface].normal);
      const float along = ray.direction[0] * n[0] + ray.direction[1] * n[1] + ray.direction[2] * n[2];
      for (size_t axis = 0; axis < 3; ++axis) {
        ray.origin[axis] += hit.t * ray.direction[axis];
        ray.direction[axis] -= 2 * along * n[axis];
      }
    }
  return escaped;
}

}  // namespace

TEST_CASE("a million rays at edges and vertices of closed rooms, and at random: no leak") {
  for (const Room shape : {Room::box, Room::ball}) {
    const std::vector<Corners> triangles = room(shape, 16, 7.3);
    const DeviceScene uploaded = make_device_scene(context(), scene_of_triangles(triangles), false);
    for (const Aim aim : {Aim::edges, Aim::vertices, Aim::anywhere}) {
      CAPTURE(static_cast<int>(aim));
      const std::vector<Ray> rays = aimed_rays(triangles, aim, 260000, {0.1, -0.2, 0.3}, 3, 13);
      for (const TraceShape traversal : shapes()) {
        CAPTURE(name_of(traversal));
        CHECK(misses(trace(uploaded, traversal, rays)) == 0);
      }
    }
  }
}

TEST_CASE("a million bounces inside closed rooms: no ray leaves, though the naive ones do") {
  for (const Room shape : {Room::box, Room::ball}) {
    const Scene scene = scene_of_triangles(room(shape, 16, 7.3));
    Random random(21);
    std::vector<Ray> rays;
    for (int i = 0; i < 2500; ++i) rays.push_back(ray_towards(random.in_cube(3), random.direction()));
    const Bounces bounces(scene, rays, 200);
    CHECK(bounces.segments == 500000);
    CHECK(bounces.escaped == 0);
    REQUIRE(bounces.last.size() == rays.size());
    size_t outside = 0;
    for (const Ray& ray : bounces.last)
      outside += std::abs(ray.origin[0]) > 7.3f || std::abs(ray.origin[1]) > 7.3f || std::abs(ray.origin[2]) > 7.3f;
    CHECK(outside == 0);
    CHECK(naive_escapes(scene, {rays.begin(), rays.begin() + 200}, 200) > 0);
  }
}

TEST_CASE("more candidates than the list begins with: it grows") {
  // There are two parallel mirrors with receivers between them: every alternating sequence is a candidate for every
  // receiver.
  const std::vector<Quad> quads{{{-1e4, 0, -1e4}, {2e4, 0, 0}, {0, 0, 2e4}},
                                {{-1e4, 5, -1e4}, {2e4, 0, 0}, {0, 0, 2e4}}};
  std::vector<glm::dvec3> receivers;
  for (int i = 0; i < 7000; ++i) receivers.push_back({0.01 * i, 2.5, 0});
  const Exact exact(reference::scene_of_quads(quads), {{0, 1, 0}}, receivers, all_sequences(1, 2, 5), 5);
  CHECK(exact.candidate_count == 11 * 7000);
  REQUIRE(exact.candidate_count > 1 << 16);
}

TEST_CASE("more solutions than the list begins with: it grows") {
  const std::vector<Quad> quads{{{-1e4, 0, -1e4}, {2e4, 0, 0}, {0, 0, 2e4}},
                                {{-1e4, 5, -1e4}, {2e4, 0, 0}, {0, 0, 2e4}}};
  std::vector<glm::dvec3> receivers;
  for (int i = 0; i < 3600; ++i) receivers.push_back({0.01 * i, 2.5, 0});
  const Exact exact(reference::scene_of_quads(quads), {{0, 1, 0}}, receivers, all_sequences(1, 2, 2), 2);
  CHECK(exact.solved.size() == 5 * 3600);
  REQUIRE(exact.solved.size() > 1 << 14);
  CHECK(exact.visible() == 5 * 3600);
}
