// SPDX-License-Identifier: Apache-2.0
// trace_moving after a trace of the static scene gives the hits of one trace of everything; label_rays and interact
// keep the planes that say where a ray comes from.
#include "passes/trace_moving.hpp"
#include "passes/interact.hpp"
#include "passes/label_rays.hpp"
#include "passes/scan.hpp"
#include "passes/traffic.hpp"
#include "wavetracer/device/moving.h"

using namespace wavetracer;
using namespace wavetracer::test;

TEST_CASE("the static scene, then the instances: the hits of everything at once, bit for bit") {
  const Traffic traffic(9, 71);
  const DeviceScene scene = traffic.upload();
  const auto surfaces = static_cast<uint32_t>(scene.surfaces.size());
  std::vector<Ray> rays = rays_in(10, as_many(1500, 200), surfaces, 73);
  for (uint32_t i = 0; i < rays.size(); i += 7) rays[i].surface = WT_OWN | i % 9;
  const RayQueue queue = upload(rays);
  for (const TraceShape shape : shapes()) {
    HitList hits = make_hit_list(context(), rays.size());
    Trace(context(), scene, shape, {}, Trace::Scope::fixed)(scene, queue, hits);
    TraceMoving(context(), scene)(scene, queue, hits);
    CHECK(download(hits, rays.size()) == trace(scene, shape, rays));
  }
}

TEST_CASE("labels follow a ray through its reflections") {
  const DeviceScene scene = make_device_scene(context(), scene_of_triangles(random_soup(80, 5, 4, 5)), false, 60);
  std::vector<Ray> rays = rays_in(4, 700, 0, 7);
  for (uint32_t i = 0; i < rays.size(); ++i) {
    rays[i].surface = WT_NONE;
    rays[i].node = WT_ROOT | (i < 300 ? 4 : 9);
  }
  const RayQueue plain = upload(rays);
  RayQueue queue = make_ray_queue(context(), rays.size(), "rays", WT_RAY_LABELLED_PLANES);
  RayQueue next = make_ray_queue(context(), rays.size(), "next rays", WT_RAY_LABELLED_PLANES);
  context().copy(plain.planes, queue.planes, plain.planes.bytes());
  queue.count = plain.count;
  std::vector<uint32_t> order(400);
  for (uint32_t k = 0; k < 400; ++k) order[k] = 399 - k;
  LabelRays label(context());
  label(queue, 0, 300, 1000);
  label(queue, 300, 400, 2000, context().buffer(order, "order"));

  const auto word = [](const RayQueue& q, uint32_t plane, uint32_t i) {
    return std::bit_cast<uint32_t>(q.planes.read_one(size_t{plane} * q.capacity + i));
  };
  CHECK(word(queue, WT_RAY_SAMPLE, 17) == 1017);
  CHECK(word(queue, WT_RAY_SAMPLE, 317) == 2000 + 399 - 17);
  CHECK(word(queue, WT_RAY_REGION, 299) == 4);
  CHECK(word(queue, WT_RAY_REGION, 300) == 9);
  CHECK(word(queue, WT_RAY_LEFT, 5) == WT_NONE);
  CHECK(word(queue, WT_RAY_ENTRY, 5) == WT_NONE);

  HitList hits = make_hit_list(context(), rays.size());
  Trace trace(context(), scene, shapes().front());
  trace(scene, queue, hits);
  const uint32_t hit_count = Scan(context())(hits.block_hits, hits.blocks(queue.count));
  auto trie = context().buffer<uint64_t>(4096, "trie");
  context().fill(trie, WT_EMPTY);
  Counters counters(context());
  auto quarters = context().buffer<uint32_t>(4096, "quarters");
  context().fill(quarters, 0);
  Interact(context(), {.labels = true})(scene, queue, hits, hit_count, {trie, quarters, counters},
                                        {.reflected = &next});
  REQUIRE(next.count == hit_count);
  REQUIRE(hit_count > 100);
  uint32_t j = 0;
  for (uint32_t i = 0; i < queue.count; ++i) {
    const auto primitive = std::bit_cast<uint32_t>(hits.planes.read_one(size_t{WT_HIT_PRIMITIVE} * hits.capacity + i));
    if (primitive == WT_NONE) continue;
    CHECK(word(next, WT_RAY_SAMPLE, j) == word(queue, WT_RAY_SAMPLE, i));
    CHECK(word(next, WT_RAY_REGION, j) == word(queue, WT_RAY_REGION, i));
    CHECK(word(next, WT_RAY_LEFT, j) == primitive);
    ++j;
  }
  CHECK(j == hit_count);
}
