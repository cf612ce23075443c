// SPDX-License-Identifier: Apache-2.0
// pack_rays: rays and hits go to planes and back, each word to its place, and nothing behind them is touched.
#include "passes/pack_rays.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

#include "passes/on_device.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

std::vector<wt_packed_ray> numbered_rays(uint32_t count) {
  std::vector<wt_packed_ray> rays;
  for (uint32_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(10 * i);
    rays.push_back({{x, x + 1, x + 2}, 0.5f, {x + 3, x + 4, x + 5}, 99});
  }
  return rays;
}

uint32_t word_of(const RayQueue& queue, size_t plane, size_t i) {
  return std::bit_cast<uint32_t>(queue.planes.read_one(plane * queue.capacity + i));
}

}  // namespace

TEST_CASE("rays in planes: origins, directions, labels, and the rays again") {
  for (const uint32_t count : {0u, 1u, 300u}) {
    const std::vector<wt_packed_ray> rays = numbered_rays(count);
    for (const uint32_t planes : {uint32_t{WT_RAY_PLANES}, uint32_t{WT_RAY_LABELLED_PLANES}}) {
      CAPTURE(count);
      CAPTURE(planes);
      RayQueue queue = make_ray_queue(context(), count, "queue", planes);
      queue.planes.write(std::vector<float>(queue.planes.size(), 7.0f));
      std::vector<uint32_t> left, regions;
      for (uint32_t i = 0; i < count; ++i) {
        left.push_back(i % 3 ? i : WT_NONE);
        regions.push_back(i % 5);
      }
      PackRays pass(context());
      const auto given = context().buffer(rays, "rays");
      const auto left_ones = context().buffer(left, "left"), regions_of = context().buffer(regions, "regions");
      pass(given, count, queue, &left_ones, &regions_of);
      const std::vector<Ray> found = download(queue);
      REQUIRE(found.size() == count);
      size_t wrong = 0;
      for (uint32_t i = 0; i < count; ++i) {
        const wt_packed_ray& r = rays[i];
        wrong += found[i] != Ray{{r.origin[0], r.origin[1], r.origin[2]},
                                 {r.direction[0], r.direction[1], r.direction[2]},
                                 left[i],
                                 wt_with_quarter(WT_ROOT | regions[i], i)};
        if (planes == WT_RAY_PLANES) continue;
        wrong += word_of(queue, WT_RAY_SAMPLE, i) != i || word_of(queue, WT_RAY_LEFT, i) != left[i] ||
                 word_of(queue, WT_RAY_REGION, i) != regions[i] || word_of(queue, WT_RAY_ENTRY, i) != WT_NONE;
      }
      CHECK(wrong == 0);
      CHECK(queue.planes.read_one(count) == 7);
      auto packed = context().buffer<wt_packed_ray>(count + 1, "packed");
      packed.write(std::vector<wt_packed_ray>(count + 1, {{7, 7, 7}, 7, {7, 7, 7}, 7}));
      pass.unpack(queue, packed);
      const std::vector<wt_packed_ray> back = packed.read();
      for (uint32_t i = 0; i < count; ++i) {
        for (int axis = 0; axis < 3; ++axis)
          wrong += back[i].origin[axis] != rays[i].origin[axis] || back[i].direction[axis] != rays[i].direction[axis];
        wrong += back[i].t_min != 0 || back[i].t_max != std::numeric_limits<float>::infinity();
      }
      CHECK(wrong == 0);
      CHECK(back[count].t_min == 7);
    }
  }
}

TEST_CASE("rays without left triangles and regions leave none, and belong to region 0") {
  RayQueue queue = make_ray_queue(context(), 20, "queue", WT_RAY_LABELLED_PLANES);
  PackRays pass(context());
  pass(context().buffer(numbered_rays(20), "rays"), 20, queue);
  for (const Ray& ray : download(queue)) CHECK(ray.surface == WT_NONE);
  CHECK(word_of(queue, WT_RAY_LEFT, 19) == WT_NONE);
  CHECK(word_of(queue, WT_RAY_REGION, 19) == 0);
}

TEST_CASE("hits in planes, and the hits again; a miss stays a miss") {
  const float endless = std::numeric_limits<float>::infinity();
  std::vector<wt_packed_hit> hits;
  for (uint32_t i = 0; i < 300; ++i) hits.push_back({static_cast<float>(i), i % 7 ? i : WT_NONE, 0.25f, 0.5f});
  HitList list = make_hit_list(context(), hits.size());
  PackRays pass(context());
  pass(context().buffer(hits, "hits"), 300, list);
  const std::vector<Hit> found = download(list, hits.size());
  auto packed = context().buffer(std::vector<wt_packed_hit>(301, {7, 7, 7, 7}), "packed");
  pass.unpack(list, 300, packed);
  const std::vector<wt_packed_hit> back = packed.read();
  size_t wrong = 0;
  for (uint32_t i = 0; i < 300; ++i) {
    const bool missed = i % 7 == 0;
    wrong += found[i] != (missed ? Hit{} : Hit{static_cast<float>(i), i, i});
    wrong += back[i].t != (missed ? endless : static_cast<float>(i)) || back[i].primitive != hits[i].primitive ||
             back[i].u != 0 || back[i].v != 0;
  }
  CHECK(wrong == 0);
  CHECK(back[300].t == 7);
}

TEST_CASE("faults of the caller of pack_rays: lists that are too short") {
  RayQueue queue = make_ray_queue(context(), 20, "queue");
  const auto rays = context().buffer(numbered_rays(20), "rays");
  const auto left = context().buffer<uint32_t>(19, "left");
  auto packed = context().buffer<wt_packed_ray>(19, "packed");
  PackRays pass(context());
  CHECK_THROWS_AS(pass(rays, 21, queue), std::invalid_argument);
  CHECK_THROWS_AS(pass(rays, 20, queue, &left), std::invalid_argument);
  pass(rays, 20, queue);
  CHECK_THROWS_AS(pass.unpack(queue, packed), std::invalid_argument);
}
