// SPDX-License-Identifier: Apache-2.0
// generate_rays: launch index to direction is one pure function, the same on the device as on the host.
#include "passes/generate_rays.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <string>

#include "passes/host_launch.hpp"
#include "passes/triangles.hpp"
#include "wavetracer/device/moving.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint64_t launch_seed = 42;
constexpr Directions maps[] = {"horizon", "hilbert", "fibonacci", "random"};

// Two tables of heights; launches here take the second.
const std::vector<float>& height_tables() {
  static const std::vector<float> tables = [] {
    const HeightShare first[] = {{1, 0.5, true}}, second[] = {{2, 0.01, false}, {1, 0.1, true}};
    std::vector<float> out = height_table(first, 0), more = height_table(second, 0.25);
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }();
  return tables;
}

std::shared_ptr<const LaunchHeights> launch_heights() {
  const auto out = std::make_shared<LaunchHeights>(context());
  out->set(height_tables());
  return out;
}

Launcher launcher(uint32_t transmitter, glm::dvec3 position_m, uint32_t source = WT_NONE) {
  return {transmitter, position_m, source, 1};
}

// Returns the beginning of the ray with this number in its launch.
uint32_t numbered(uint32_t root, uint64_t number) {
  return root | static_cast<uint32_t>(number & 3) << WT_QUARTER_SHIFT;
}

GenerateRays generator(Directions map, uint64_t n) {
  return GenerateRays(context(), LaunchDirections(map, n, launch_seed), launch_heights());
}

Float3 host_direction(const HostLaunch& launch, uint64_t i) {
  const device::wt_direction d = launch.direction(i, height_tables().data(), height_table_size);
  return {d.x, d.y, d.z};
}

}  // namespace

TEST_CASE("device directions are the host's, bit for bit") {
  for (const Directions map : maps)
    for (const uint32_t n : {1u, 15u, 16u, 17u, 1000u}) {
      CAPTURE(map);
      CAPTURE(n);
      GenerateRays generate = generator(map, n);
      RayQueue queue = make_ray_queue(context(), n, "rays");
      generate(queue, launcher(3, {1.5, -2.25, 0.125}), 0, n);
      REQUIRE(queue.count == n);
      const std::vector<Ray> rays = download(queue);
      const HostLaunch launch(map, n, launch_seed);
      size_t different = 0;
      for (uint32_t i = 0; i < n; ++i)
        different +=
            rays[i] != Ray{{1.5f, -2.25f, 0.125f}, host_direction(launch, i), WT_NONE, numbered(WT_ROOT | 3, i)};
      CHECK(different == 0);
    }
}

TEST_CASE("a ray's quarter is its number in the launch: of every index, of a share, in an order, from the middle on") {
  GenerateRays generate = generator("horizon", 4000);
  const auto quarters = [](const RayQueue& queue) {
    std::vector<uint32_t> out;
    for (const Ray& ray : download(queue)) {
      CHECK((ray.node & ~WT_QUARTER_BITS) == (WT_ROOT | 5));
      out.push_back(ray.node >> WT_QUARTER_SHIFT & 3);
    }
    return out;
  };
  for (const uint64_t stride : {1, 4, 7}) {
    CAPTURE(stride);
    const uint64_t phase = stride - 1;
    RayQueue queue = make_ray_queue(context(), 140, "rays");
    generate(queue, launcher(5, {0, 0, 0}), phase, 37, stride);
    generate(queue, launcher(5, {0, 0, 0}), phase + 37 * stride, 70, stride);
    std::vector<uint32_t> expected;
    for (uint32_t number = 0; number < 107; ++number) expected.push_back(number % 4);
    CHECK(quarters(queue) == expected);
  }
  std::vector<uint32_t> order(100 + 16), expected;
  for (uint32_t k = 0; k < 100; ++k) order[k] = k * 37 % 100;
  for (uint32_t k = 0; k < 100; ++k) expected.push_back((50 + order[k]) % 4);
  RayQueue queue = make_ray_queue(context(), 140, "rays");
  generate(queue, launcher(5, {0, 0, 0}), 50, 100, context().buffer(order, "order"));
  CHECK(quarters(queue) == expected);
}

TEST_CASE("large launch indices: the last of 2^31 rays are the host's") {
  constexpr uint64_t n = uint64_t{1} << 31;
  for (const Directions map : maps) {
    CAPTURE(map);
    GenerateRays generate = generator(map, n);
    RayQueue queue = make_ray_queue(context(), 100, "rays");
    generate(queue, launcher(0, {0, 0, 0}), n - 100, 100);
    const std::vector<Ray> rays = download(queue);
    const HostLaunch launch(map, n, launch_seed);
    size_t different = 0;
    for (uint32_t i = 0; i < 100; ++i) different += rays[i].direction != host_direction(launch, n - 100 + i);
    CHECK(different == 0);
  }
}

TEST_CASE("a launch in parts, and of several transmitters, gives the same rays") {
  constexpr uint32_t n = 300;
  for (const Directions map : maps) {
    CAPTURE(map);
    GenerateRays generate = generator(map, n);
    RayQueue whole = make_ray_queue(context(), 2 * n, "whole"), parts = make_ray_queue(context(), 2 * n, "parts");
    generate(whole, launcher(0, {1, 2, 3}), 0, n);
    generate(whole, launcher(1, {-4, 5, 6}), 0, n);
    for (const auto& [first, count] : {std::pair{0u, 1u}, {1u, 15u}, {16u, 16u}, {32u, 17u}, {49u, n - 49}})
      generate(parts, launcher(0, {1, 2, 3}), first, count);
    for (const auto& [first, count] : {std::pair{0u, 157u}, {157u, n - 157}})
      generate(parts, launcher(1, {-4, 5, 6}), first, count);
    CHECK(download(parts) == download(whole));
  }
}

TEST_CASE("a share of the directions: every stride-th launch index, with the surface that the rays leave") {
  constexpr uint64_t n = 100000;
  constexpr uint32_t count = 100, source = WT_OWN | 5;
  for (const Directions map : maps)
    for (const uint64_t stride : {uint64_t{1}, uint64_t{10}, uint64_t{997}}) {
      CAPTURE(map);
      CAPTURE(stride);
      GenerateRays generate = generator(map, n);
      RayQueue queue = make_ray_queue(context(), count, "rays");
      // In two parts, the first of which ends within the 16 rays of a work-item.
      generate(queue, launcher(2, {1, 2, 3}, source), 7, 37, stride);
      generate(queue, launcher(2, {1, 2, 3}, source), 7 + 37 * stride, count - 37, stride);
      const std::vector<Ray> rays = download(queue);
      REQUIRE(rays.size() == count);
      const HostLaunch launch(map, n, launch_seed);
      size_t different = 0;
      for (uint32_t k = 0; k < count; ++k)
        different += rays[k] != Ray{{1, 2, 3},
                                    host_direction(launch, 7 + stride * k),
                                    source,
                                    numbered(WT_ROOT | 2, (7 + stride * k) / stride)};
      CHECK(different == 0);
    }
}

TEST_CASE("launchers that share a launch get the rays that each gets alone") {
  constexpr uint64_t n = 10'000;
  constexpr uint32_t count = 160;  // number of rays of each kind
  for (const Directions map : maps)
    for (const uint64_t stride : {uint64_t{1}, uint64_t{13}}) {
      CAPTURE(map);
      CAPTURE(stride);
      GenerateRays generate = generator(map, n);
      REQUIRE(count % generate.rays_together() == 0);
      const std::vector<Launcher> who{launcher(0, {1, 2, 3}), launcher(5, {-4, 5, 6}, WT_OWN | 5),
                                      launcher(2, {7, -8, 9})};
      RayQueue one = make_ray_queue(context(), 600, "one"), together = make_ray_queue(context(), 600, "together");
      for (RayQueue* queue : {&one, &together}) generate(*queue, launcher(9, {0, 0, 1}), 0, 33);
      for (const Launcher& from : who) generate(one, from, 7, count, stride);
      generate(together, who, 7, count, stride);
      CHECK(together.count == one.count);
      CHECK(download(together) == download(one));
    }
}

TEST_CASE("stride launches from every phase are together the whole launch") {
  constexpr uint64_t n = 203, stride = 10;
  GenerateRays generate = generator("hilbert", n);
  RayQueue whole = make_ray_queue(context(), n, "whole"), shares = make_ray_queue(context(), n, "shares");
  generate(whole, launcher(0, {0, 0, 0}), 0, n);
  for (uint64_t phase = 0; phase < stride; ++phase)
    generate(shares, launcher(0, {0, 0, 0}), phase, static_cast<uint32_t>((n - phase + stride - 1) / stride), stride);
  std::multiset<Float3> one, other;
  for (const Ray& ray : download(whole)) one.insert(ray.direction);
  for (const Ray& ray : download(shares)) other.insert(ray.direction);
  CHECK(one == other);
}

TEST_CASE("an order is followed, and its rays leave what they should") {
  constexpr uint32_t n = 1000, count = 50, first = 300, source = WT_OWN | 1;
  std::vector<uint32_t> order(count + 16, 0);
  for (uint32_t k = 0; k < count; ++k) order[k] = (37 * k + 11) % count;
  GenerateRays generate = generator("hilbert", n);
  RayQueue queue = make_ray_queue(context(), count, "rays");
  generate(queue, launcher(1, {4, 5, 6}, source), first, count, context().buffer(order, "order"));
  const std::vector<Ray> rays = download(queue);
  const HostLaunch launch("hilbert", n, launch_seed);
  size_t different = 0;
  for (uint32_t k = 0; k < count; ++k)
    different +=
        rays[k] !=
        Ray{{4, 5, 6}, host_direction(launch, first + order[k]), source, numbered(WT_ROOT | 1, first + order[k])};
  CHECK(different == 0);
}

TEST_CASE("samples: the ray of a cell and a launcher, with its number, and an end that is a root") {
  Directions map;
  SUBCASE("horizon") { map = "horizon"; }
  SUBCASE("hilbert") { map = "hilbert"; }
  constexpr uint32_t level = 7, cells = sample_faces << (2 * level), count = 300;
  const std::vector<glm::dvec3> origins{{1, 2, 3}, {-4, 5, 0.5}};
  const std::vector<uint32_t> roots{WT_ROOT | 4, WT_ROOT | 9}, sources{WT_NONE, WT_OWN | 3};
  std::vector<float> launchers;
  for (size_t i = 0; i < 2; ++i) {
    for (const float x : to_float(origins[i])) launchers.push_back(x);
    launchers.insert(launchers.end(), {0, std::bit_cast<float>(roots[i]), std::bit_cast<float>(sources[i]),
                                       std::bit_cast<float>(static_cast<uint32_t>(i) * height_table_size), 0});
  }
  SampleList list = make_sample_list(context(), count);
  std::vector<uint32_t> cell(count), owner(count), untouched(list.capacity, 77);
  Random random(3);
  for (uint32_t i = 0; i < count; ++i) {
    cell[i] = random.below(cells);
    owner[i] = random.below(2);
  }
  list.samples.write(cell);
  list.samples.write(owner, list.capacity);
  list.ends.write(untouched);
  list.count = count;
  list.level = level;
  const LaunchDirections directions(map, cells, 0);
  const HostLaunch launch(map, cells, 0);
  GenerateRays generate = generator(map, 12345);
  RayQueue queue = make_ray_queue(context(), count, "rays", WT_RAY_PLANES + 1);
  for (const auto& [first, part] : {std::pair{0u, 100u}, {100u, 131u}, {231u, 69u}}) {
    CAPTURE(first);
    generate.samples(queue, list, first, part, context().buffer(launchers, "launchers"), directions);
    REQUIRE(queue.count == part);
    const std::vector<Ray> rays = download(queue);
    const std::vector<float> numbers = queue.planes.read(size_t{WT_RAY_SAMPLE} * queue.capacity, part);
    size_t different = 0;
    for (uint32_t k = 0; k < part; ++k) {
      const uint32_t i = first + k, from = owner[i];
      const device::wt_direction d = launch.direction(cell[i], height_tables().data(), from * height_table_size);
      different +=
          rays[k] != Ray{to_float(origins[from]), {d.x, d.y, d.z}, sources[from], numbered(roots[from], cell[i])};
      different += std::bit_cast<uint32_t>(numbers[k]) != i;
    }
    CHECK(different == 0);
    const std::vector<uint32_t> ends = list.ends.read();
    size_t wrong = 0;
    for (uint32_t i = 0; i < list.capacity; ++i) wrong += ends[i] != (i < first + part ? roots[owner[i]] : 77);
    CHECK(wrong == 0);
  }
}

TEST_CASE("more rays than the queue holds are refused") {
  GenerateRays generate = generator("fibonacci", 5000);
  RayQueue queue = make_ray_queue(context(), 100, "rays");
  CHECK_THROWS_AS(generate(queue, launcher(0, {0, 0, 0}), 0, 5000), std::logic_error);
}
