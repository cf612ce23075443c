// SPDX-License-Identifier: Apache-2.0
// order_keys and gather_rays: the corrected histogram of the thesis (algorithm 1), against its lists; keys of queues
// and of launches agree; rays are moved, never changed. Each fault of the original has a test.
#include "passes/order_keys.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "passes/gather_rays.hpp"
#include "passes/generate_rays.hpp"
#include "passes/sort.hpp"
#include "passes/triangles.hpp"
#include "wavetracer/device/curves.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr OrderKey all_keys[] = {OrderKey::morton, OrderKey::morton_bins, OrderKey::hilbert_bins,
                                 OrderKey::direction_origin};

std::vector<uint32_t> keys_of(OrderKeys& order_keys, const RayQueue& queue) {
  gpu::Buffer<uint32_t> keys = context().buffer<uint32_t>(queue.count + 16, "keys");
  order_keys(queue, keys);
  return keys.read(0, queue.count);
}

RayQueue launched(const LaunchDirections& directions, uint32_t n) {
  RayQueue queue = make_ray_queue(context(), n, "rays");
  GenerateRays(context(), directions)(queue, {0, {1, 2, 3}}, 0, n);
  return queue;
}

// The order that `key` gives to the rays of a queue.
std::vector<uint32_t> order_of(OrderKey key, uint32_t bins, const LaunchDirections& directions, const RayQueue& queue) {
  OrderKeys order_keys(context(), key, bins, directions, 10);
  Sort sort(context());
  gpu::Buffer<uint32_t> keys = context().buffer<uint32_t>(queue.count + 16, "keys");
  gpu::Buffer<uint32_t> order = context().buffer<uint32_t>(queue.count + 16, "order");
  order_keys(queue, keys);
  sort(keys, order, queue.count, order_keys.queue_bits());
  return order.read(0, queue.count);
}

// Algorithm 1 of the thesis with its two faults mended: coordinates are scaled to bin_num, not to half of it, and the
// lists keep the rays as they are. Bins are visited in the order of `code`.
template <class Code>
std::vector<uint32_t> by_lists(const std::vector<Ray>& rays, uint32_t bin_num, const Code& code) {
  const auto bin = [&](double c) { return std::min(static_cast<uint32_t>((c + 1) / 2 * bin_num), bin_num - 1); };
  std::map<uint32_t, std::vector<uint32_t>> histogram;
  for (uint32_t i = 0; i < rays.size(); ++i) {
    const Float3& d = rays[i].direction;
    histogram[code(bin(d[0]), bin(d[1]), bin(d[2]))].push_back(i);
  }
  std::vector<uint32_t> order;
  for (const auto& [unused, list] : histogram) order.insert(order.end(), list.begin(), list.end());
  return order;
}

// Algorithm 1 as the thesis prints it: bins, in the order of `code`, of vectors.
template <class Code>
std::vector<Float3> by_printed_lists(const std::vector<Ray>& rays, uint32_t bin_num, const Code& code) {
  std::map<uint32_t, std::vector<Float3>> histogram;
  for (const Ray& element : rays) {
    const Float3& d = element.direction;
    const Float3 v = {(d[0] + 1) / 2, (d[1] + 1) / 2, (d[2] + 1) / 2};
    const auto bin = [&](float c) { return static_cast<uint32_t>(std::floor(c * static_cast<float>(bin_num) / 2)); };
    histogram[code(bin(v[0]), bin(v[1]), bin(v[2]))].push_back(v);
  }
  std::vector<Float3> out;
  for (const auto& [unused, list] : histogram) out.insert(out.end(), list.begin(), list.end());
  return out;
}

// Listing A.1, as the thesis prints it and, with `mended`, with z in place of the second x.
uint32_t expandBits(uint32_t v) {
  v = (v * 0x00010001u) & 0xFF0000FFu;
  v = (v * 0x00000101u) & 0x0F00F00Fu;
  v = (v * 0x00000011u) & 0xC30C30C3u;
  return (v * 0x00000005u) & 0x49249249u;
}

uint32_t morton3D(float x, float y, float z, bool mended) {
  x = std::min(std::max(x * 1024.0f, 0.0f), 1023.0f);
  y = std::min(std::max(y * 1024.0f, 0.0f), 1023.0f);
  (mended ? z : x) = std::min(std::max(z * 1024.0f, 0.0f), 1023.0f);
  return expandBits(static_cast<uint32_t>(x)) * 4 + expandBits(static_cast<uint32_t>(y)) * 2 +
         expandBits(static_cast<uint32_t>(z));
}

}  // namespace

TEST_CASE("the histogram's order is that of its lists along the curve, for any number of bins") {
  const LaunchDirections directions("random", 3000, 7);
  const RayQueue queue = launched(directions, 3000);
  const std::vector<Ray> rays = download(queue);
  for (const uint32_t bins : {1u, 2u, 7u, 16u, 100u, 1024u}) {
    CAPTURE(bins);
    const auto level = static_cast<unsigned>(std::bit_width(bins - 1));
    CHECK(order_of(OrderKey::hilbert_bins, bins, directions, queue) ==
          by_lists(rays, bins, [&](auto x, auto y, auto z) { return device::wt_hilbert3_encode32(x, y, z, level); }));
    const auto morton = [](auto x, auto y, auto z) { return device::wt_morton3_encode32(x, y, z); };
    CHECK(order_of(OrderKey::morton_bins, bins, directions, queue) == by_lists(rays, bins, morton));
  }
}

TEST_CASE("every bin that the sphere meets is used, up to the outermost") {
  // The original multiplies an already halved coordinate by half the number of bins: bins beyond the middle stay empty.
  const LaunchDirections directions("fibonacci", 4096, 1);
  const RayQueue queue = launched(directions, 4096);
  OrderKeys order_keys(context(), OrderKey::morton_bins, 8, directions, 10);
  CHECK(order_keys.queue_bits() == 9);
  std::set<uint32_t> used[3];
  for (const uint32_t key : keys_of(order_keys, queue))
    for (unsigned axis = 0; axis < 3; ++axis) {
      uint32_t cell = 0;
      for (unsigned bit = 0; bit < 3; ++bit) cell |= (key >> (3 * bit + axis) & 1) << bit;
      used[axis].insert(cell);
    }
  for (const auto& cells : used) CHECK(cells.size() == 8);
}

TEST_CASE("rays of a sorted queue are those that it had, each once, their directions to the last bit") {
  // The original stores the coordinates mapped to [0, 1] as the direction.
  const LaunchDirections directions("random", 1000, 3);
  RayQueue queue = launched(directions, 1000);
  RayQueue sorted = make_ray_queue(context(), 1000, "sorted");
  const std::vector<Ray> before = download(queue);
  const std::vector<uint32_t> order = order_of(OrderKey::hilbert_bins, 16, directions, queue);
  GatherRays gather(context());
  gather(queue, context().buffer(order, "order"), queue.count, sorted);
  const std::vector<Ray> after = download(sorted);
  REQUIRE(after.size() == before.size());
  size_t different = 0;
  for (size_t i = 0; i < after.size(); ++i) different += after[i] != before[order[i]];
  CHECK(different == 0);
  std::vector<uint32_t> each_once = order;
  std::sort(each_once.begin(), each_once.end());
  std::vector<uint32_t> all(before.size());
  std::iota(all.begin(), all.end(), 0u);
  CHECK(each_once == all);
}

TEST_CASE("keys of launch indices are those of the launched rays") {
  for (const Directions map : std::to_array<Directions>({"hilbert", "fibonacci", "random"}))
    for (const OrderKey key : {OrderKey::morton, OrderKey::morton_bins, OrderKey::hilbert_bins}) {
      CAPTURE(map);
      const LaunchDirections directions(map, 500, 5);
      const RayQueue queue = launched(directions, 500);
      OrderKeys order_keys(context(), key, 16, directions, 10);
      const std::vector<uint32_t> expected = keys_of(order_keys, queue);
      for (const auto& [first, count] : {std::pair{0u, 500u}, {17u, 1u}, {100u, 33u}}) {
        gpu::Buffer<uint32_t> keys = context().buffer<uint32_t>(count + 16, "keys");
        order_keys(first, count, keys);
        CHECK(keys.read(0, count) == std::vector<uint32_t>(expected.begin() + first, expected.begin() + first + count));
      }
    }
}

TEST_CASE("a launch in an order of its own has the rays of the plain launch, permuted") {
  const LaunchDirections directions("hilbert", 300, 1);
  const std::vector<Ray> plain = download(launched(directions, 300));
  std::vector<uint32_t> order(100 + 16);
  for (uint32_t i = 0; i < 100; ++i) order[i] = (i * 37) % 100;
  RayQueue queue = make_ray_queue(context(), 300, "rays");
  GenerateRays(context(), directions)(queue, {0, {1, 2, 3}}, 150, 100, context().buffer(order, "order"));
  const std::vector<Ray> rays = download(queue);
  REQUIRE(rays.size() == 100);
  for (uint32_t i = 0; i < 100; ++i) CHECK(rays[i] == plain[150 + order[i]]);
}

TEST_CASE("direction-origin: directions lead, origins decide among equal ones") {
  const LaunchDirections directions("hilbert", 64, 1);
  std::vector<Ray> rays;
  for (const Float3 d : {Float3{1, 0, 0}, Float3{0.999f, 0.0447f, 0}, Float3{-1, 0, 0}})
    for (const float x : {-9.0f, 0.0f, 9.0f}) rays.push_back({{x, 1, 2}, d});
  OrderKeys order_keys(context(), OrderKey::direction_origin, 16, directions, 10);
  const std::vector<uint32_t> keys = keys_of(order_keys, upload(rays));
  for (size_t i = 0; i < keys.size(); ++i) CHECK((keys[i] >> order_keys.queue_bits()) == 0);
  for (size_t d = 0; d < 9; d += 3) {
    CHECK(keys[d] < keys[d + 1]);
    CHECK(keys[d + 1] < keys[d + 2]);
    CHECK((keys[d] >> 12) == (keys[d + 2] >> 12));
  }
  CHECK((keys[0] >> 12) != (keys[6] >> 12));
}

TEST_CASE("direction-origin: launch indices and rays have the same cells of directions, finer ones at launch") {
  for (const Directions map : std::to_array<Directions>({"hilbert", "fibonacci", "random"})) {
    CAPTURE(map);
    const LaunchDirections directions(map, 5000, 3);
    OrderKeys order_keys(context(), OrderKey::direction_origin, 16, directions, 10);
    gpu::Buffer<uint32_t> buffer = context().buffer<uint32_t>(5000 + 16, "keys");
    order_keys(uint64_t{0}, 5000, buffer);
    const std::vector<uint32_t> of_launch = buffer.read(0, 5000),
                                of_rays = keys_of(order_keys, launched(directions, 5000));
    REQUIRE(order_keys.launch_bits() == 16);
    for (size_t i = 0; i < of_rays.size(); ++i) REQUIRE((of_launch[i] >> 4) == (of_rays[i] >> 12));
  }
}

TEST_CASE("direction-origin at launch: cells of directions, neighbours in key are neighbours on the sphere") {
  const LaunchDirections directions("random", 4000, 3);
  const std::vector<Ray> rays = download(launched(directions, 4000));
  OrderKeys order_keys(context(), OrderKey::direction_origin, 16, directions, 10);
  gpu::Buffer<uint32_t> buffer = context().buffer<uint32_t>(4000 + 16, "keys");
  order_keys(uint64_t{0}, 4000, buffer);
  const std::vector<uint32_t> keys = buffer.read(0, 4000);
  std::vector<uint32_t> order(4000);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return keys[a] < keys[b]; });
  double sum = 0;
  for (size_t i = 1; i < order.size(); ++i)
    sum += glm::length(to_double(rays[order[i]].direction) - to_double(rays[order[i - 1]].direction));
  // Neighbours of a square lattice of 4,000 are 0.056 apart; random ones 1.33.
  CHECK(sum / 3999 < 0.12);
  // 4,000 thrown into 65,536 cells of about equal size meet some 120 times.
  CHECK(std::set<uint32_t>(keys.begin(), keys.end()).size() > 3750);
  CHECK(*std::max_element(keys.begin(), keys.end()) < 65536);
}

TEST_CASE("keys stay within their bits, and bins outside 1 to 1024 are refused") {
  const LaunchDirections directions("random", 400, 9);
  const RayQueue queue = launched(directions, 400);
  for (const OrderKey key : all_keys) {
    OrderKeys order_keys(context(), key, 33, directions, 10);
    for (const uint32_t k : keys_of(order_keys, queue)) REQUIRE((uint64_t{k} >> order_keys.queue_bits()) == 0);
  }
  CHECK_THROWS_AS(OrderKeys(context(), OrderKey::morton_bins, 0, directions, 10), std::invalid_argument);
  CHECK_THROWS_AS(OrderKeys(context(), OrderKey::hilbert_bins, 1025, directions, 10), std::invalid_argument);
}

TEST_CASE("listing A.1: mended, it is our code with x as the leading component; as printed, x has no influence") {
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const auto coordinate = [&] { return static_cast<float>(random.below(1u << 20)) * 0x1p-20f; };
    const float x = coordinate(), y = coordinate(), z = coordinate();
    const auto cell = [](float c) { return static_cast<uint32_t>(c * 1024.0f); };
    CHECK(morton3D(x, y, z, true) == device::wt_morton3_encode32(cell(z), cell(y), cell(x)));
    // The fault: z, cut to an integer, is 0, and its cell is in the place of x.
    CHECK(morton3D(x, y, z, false) == device::wt_morton3_encode32(0, cell(y), cell(z)));
    CHECK(morton3D(x, y, z, false) == morton3D(1 - x, y, z, false));
  }
}

TEST_CASE("algorithm 1 as printed: 16 bins sort as our 8 do, and directions are lost") {
  const LaunchDirections directions("random", 3000, 7);
  const RayQueue queue = launched(directions, 3000);
  const std::vector<Ray> rays = download(queue);
  const auto morton = [](auto x, auto y, auto z) { return device::wt_morton3_encode32(x, y, z); };
  const std::vector<Float3> printed = by_printed_lists(rays, 16, morton);
  const std::vector<uint32_t> mended = order_of(OrderKey::morton_bins, 8, directions, queue);
  REQUIRE(printed.size() == mended.size());
  size_t different = 0, units = 0;
  for (size_t i = 0; i < printed.size(); ++i) {
    const Float3& d = rays[mended[i]].direction;
    different += printed[i] != Float3{(d[0] + 1) / 2, (d[1] + 1) / 2, (d[2] + 1) / 2};
    const auto& [x, y, z] = printed[i];
    units += std::abs(std::sqrt(x * x + y * y + z * z) - 1) < 1e-3f;
    CHECK((x >= 0 && y >= 0 && z >= 0));  // one octant of the sphere
  }
  CHECK(different == 0);
  CHECK(units < 30);
  CHECK(order_of(OrderKey::morton_bins, 16, directions, queue) != mended);
}
