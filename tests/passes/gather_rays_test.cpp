// SPDX-License-Identifier: Apache-2.0
// gather_rays: slot i of the next queue has every word of ray order[i], to the last bit, and no other word changes.
#include "passes/gather_rays.hpp"

#include <doctest/doctest.h>

#include <numeric>

#include "passes/queue_words.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Gathers rays of one queue of random words into another, and compares with a loop over planes and rays.
void check_gathered(uint32_t rays, const std::vector<uint32_t>& order, uint32_t planes, uint32_t next_planes) {
  CAPTURE(rays);
  CAPTURE(planes);
  CAPTURE(next_planes);
  const RayQueue queue = random_queue(1, rays, planes);
  RayQueue next = random_queue(2, rays, next_planes);
  next.count = 0;
  const std::vector<uint32_t> from = words_of(queue);
  std::vector<uint32_t> expected = words_of(next);
  for (size_t plane = 0; plane < next_planes; ++plane)
    for (size_t i = 0; i < order.size(); ++i)
      expected[plane * next.capacity + i] = from[plane * queue.capacity + order[i]];
  GatherRays gather(context());
  gather(queue, context().buffer(order, "order"), static_cast<uint32_t>(order.size()), next);
  CHECK(next.count == order.size());
  CHECK(words_of(next) == expected);
  CHECK(words_of(queue) == from);
}

}  // namespace

TEST_CASE("gather_rays: a permutation moves all rays, for numbers around those that a work-item takes") {
  Random random(3);
  for (const uint32_t rays : {1u, 2u, 15u, 16u, 17u, 255u, 256u, 257u, 1000u}) {
    std::vector<uint32_t> order(rays);
    std::iota(order.begin(), order.end(), 0u);
    for (uint32_t i = rays; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    check_gathered(rays, order, WT_RAY_PLANES, WT_RAY_PLANES);
  }
}

TEST_CASE("gather_rays: a list takes some rays, in any order and more than once, with all planes or the first ones") {
  Random random(4);
  for (const auto& [rays, count] : {std::pair{700u, 300u}, {300u, 33u}, {40u, 1u}, {5u, 200u}}) {
    std::vector<uint32_t> order(count);
    for (uint32_t& ray : order) ray = random.below(rays);
    check_gathered(rays, order, WT_RAY_LABELLED_PLANES, WT_RAY_LABELLED_PLANES);
    check_gathered(rays, order, WT_RAY_LABELLED_PLANES, WT_RAY_PLANES);
    check_gathered(rays, order, WT_RAY_PLANES + 1, WT_RAY_PLANES + 1);
  }
}
