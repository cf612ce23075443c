// SPDX-License-Identifier: Apache-2.0
// Windows of generate_rays: rays of antennas far away use only a part of the sphere, as evenly as without it, and start
// on a sphere around the antenna; the same on the device as on the host.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "passes/generate_rays.hpp"
#include "passes/host_launch.hpp"
#include "passes/order_keys.hpp"
#include "passes/triangles.hpp"
#include "wavetracer/device/directions.h"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr Directions window_maps[] = {"horizon", "hilbert", "fibonacci", "random"};
constexpr double half_rad = 0.01, low = -0.004, high = 0.002, ahead_m = 3e7;
constexpr uint64_t window_seed = 42;

// The frame of a satellite that sees its scene to the north-east, 60 degrees down.
const glm::dvec3 window_x = glm::normalize(glm::dvec3(1, 1, -std::sqrt(6.0)));
const glm::dvec3 window_z = glm::normalize(glm::dvec3(0, 0, 1) - window_x.z * window_x);
const glm::dvec3 window_y = glm::cross(window_z, window_x);

// A table of heights, and the window, which takes the space of two.
const std::vector<float>& window_tables() {
  static const std::vector<float> tables = [] {
    std::vector<float> out = height_table({}, 1);
    for (uint32_t i = 0; i < height_table_size; ++i)
      out.push_back(static_cast<float>(high + (low - high) * i / WT_HEIGHT_CELLS));
    out.push_back(static_cast<float>(half_rad / std::numbers::pi * 4294967296.0));
    out.push_back(static_cast<float>(ahead_m));
    for (const glm::dvec3& axis : {window_x, window_y, window_z})
      for (int k = 0; k < 3; ++k) out.push_back(static_cast<float>(axis[k]));
    out.resize(3 * size_t{height_table_size});
    return out;
  }();
  return tables;
}

GenerateRays window_generator(const LaunchDirections& directions) {
  const auto heights = std::make_shared<LaunchHeights>(context());
  heights->set(window_tables());
  return GenerateRays(context(), directions, heights);
}

device::wt_window_ray host_ray(const HostLaunch& launch, uint64_t i, uint32_t more = 0) {
  const auto [height, turn] = launch.place(i);
  return device::wt_through_window(height, turn + more, window_tables().data(), height_table_size);
}

Ray ray_of(const device::wt_window_ray& ray, const Float3& origin, uint32_t root, uint64_t number) {
  return {{origin[0] + ray.start.x, origin[1] + ray.start.y, origin[2] + ray.start.z},
          {ray.along.x, ray.along.y, ray.along.z},
          WT_NONE,
          root | static_cast<uint32_t>(number & 3) << WT_QUARTER_SHIFT};
}

Launcher through_window(const glm::dvec3& position_m) { return {3, position_m, WT_NONE, 1, true}; }

}  // namespace

TEST_CASE("windows: device rays are the host's, bit for bit, alone, of several launchers and in an order") {
  for (const Directions map : window_maps) {
    CAPTURE(map);
    constexpr uint32_t n = 1000;
    const HostLaunch launch(map, n, window_seed);
    GenerateRays generate = window_generator(LaunchDirections(map, n, window_seed));
    const Float3 origin{1.5f, -2.25f, 40};
    RayQueue alone = make_ray_queue(context(), n, "alone"), several = make_ray_queue(context(), 2 * n, "several");
    generate(alone, through_window({1.5, -2.25, 40}), 0, n);
    const std::vector<Launcher> who{through_window({1.5, -2.25, 40}), {4, {0, 0, 1}}};
    generate(several, who, 0, 992, 1);
    std::vector<uint32_t> order(n + 16);
    for (uint32_t k = 0; k < n; ++k) order[k] = k * 37 % n;
    RayQueue ordered = make_ray_queue(context(), n, "ordered");
    generate(ordered, through_window({1.5, -2.25, 40}), 0, n, context().buffer(order, "order"));
    const std::vector<Ray> a = download(alone), b = download(several), c = download(ordered);
    size_t different = 0;
    for (uint32_t i = 0; i < n; ++i) {
      const Ray expected = ray_of(host_ray(launch, i), origin, WT_ROOT | 3, i);
      different += a[i] != expected;
      if (i < 992) different += b[i] != expected;
      different += c[i] != ray_of(host_ray(launch, order[i]), origin, WT_ROOT | 3, order[i]);
    }
    CHECK(different == 0);
    // The other launcher of the same launch uses the whole sphere.
    CHECK(std::any_of(b.begin() + 992, b.end(), [](const Ray& ray) { return ray.direction[2] > 0.9f; }));
    CHECK(b[992].origin == Float3{0, 0, 1});
  }
}

TEST_CASE("windows: samples of launchers with and without one share a level, turned within the window") {
  constexpr uint32_t level = 3, cells = sample_faces << (2 * level);
  const LaunchDirections directions("hilbert", cells, 0);
  const HostLaunch launch("hilbert", cells, 0);
  SampleList list = make_sample_list(context(), 2 * cells);
  std::vector<uint32_t> cell(2 * cells), owner(2 * cells);
  for (uint32_t i = 0; i < 2 * cells; ++i) cell[i] = i / 2, owner[i] = i % 2;
  list.samples.write(cell);
  list.samples.write(owner, list.capacity);
  list.count = 2 * cells;
  std::vector<float> launchers;
  for (const uint32_t window : {1u, 0u})
    for (const float word :
         {1.f, 2.f, 3.f, 0.f, std::bit_cast<float>(uint32_t{WT_ROOT | 3}), std::bit_cast<float>(uint32_t{WT_NONE}),
          std::bit_cast<float>(window * height_table_size), std::bit_cast<float>(window)})
      launchers.push_back(word);
  GenerateRays generate = window_generator(directions);
  RayQueue queue = make_ray_queue(context(), 2 * cells, "rays", WT_RAY_PLANES + 1);
  const DirectionTurn turn{0.6f, 0.8f, 633866811};
  generate.samples(queue, list, 0, 2 * cells, context().buffer(launchers, "launchers"), directions, turn);
  const std::vector<Ray> rays = download(queue);
  size_t different = 0;
  for (uint32_t i = 0; i < cells; ++i) {
    different += rays[2 * i] != ray_of(host_ray(launch, i, turn.turn), {1, 2, 3}, WT_ROOT | 3, i);
    const device::wt_direction d = launch.direction(i);
    const Float3 turned{turn.cosine * d.x - turn.sine * d.y, turn.sine * d.x + turn.cosine * d.y, d.z};
    different += rays[2 * i + 1].direction != turned;
    different += rays[2 * i + 1].origin != Float3{1, 2, 3};
  }
  CHECK(different == 0);
}

TEST_CASE("windows: rays fill them evenly, have unit length, and start where a line from the antenna would be") {
  const glm::dvec3 antenna = -ahead_m * window_x;  // so that rays start around the origin
  for (const Directions map : window_maps) {
    CAPTURE(map);
    constexpr uint64_t n = 40000;
    constexpr int columns = 16, rows = 8;
    const HostLaunch launch(map, n, window_seed);
    std::vector<double> counts(columns * rows, 0);
    double off_m = 0, length = 0;
    for (uint64_t i = 0; i < n; ++i) {
      const device::wt_window_ray ray = host_ray(launch, i);
      const glm::dvec3 d{ray.along.x, ray.along.y, ray.along.z}, start{ray.start.x, ray.start.y, ray.start.z};
      length = std::max(length, std::abs(glm::length(d) - 1));
      const double azimuth = std::atan2(glm::dot(d, window_y), glm::dot(d, window_x)), height = glm::dot(d, window_z);
      const double column = (azimuth / half_rad + 1) / 2 * columns, row = (height - low) / (high - low) * rows;
      const int at_column = static_cast<int>(std::clamp(column, 0.0, columns - 1e-9));
      counts[static_cast<size_t>(at_column * rows + static_cast<int>(std::clamp(row, 0.0, rows - 1e-9)))] += 1;
      // The line of float32 from the antenna passes the start by what float32 leaves of 30,000 km: 2 m a component.
      off_m = std::max(off_m, glm::length(antenna + ahead_m * d / glm::length(d) - start));
    }
    CHECK(length < 1e-6);
    CHECK(off_m < 8);
    double least = n, most = 0;
    for (const double count : counts) least = std::min(least, count), most = std::max(most, count);
    const double even = double{n} / (columns * rows), spread = map == "random" ? 5 * std::sqrt(even) : 0.08 * even;
    CHECK(least > even - spread);
    CHECK(most < even + spread);
  }
}

TEST_CASE("windows: starts keep the digits that float32 would lose at the distance of a satellite") {
  // Neighbours of a row of 10^7 rays are 0.2 m apart on the scene; without starts of their own they would be 2 m or 0.
  const HostLaunch launch("fibonacci", 10'000'000, 0);
  double smallest_m = 1e9;
  std::vector<double> across;
  for (uint64_t i = 0; i < 20000; ++i) {
    const device::wt_window_ray ray = host_ray(launch, i);
    across.push_back(glm::dot(glm::dvec3(ray.start.x, ray.start.y, ray.start.z), window_y));
  }
  std::sort(across.begin(), across.end());
  size_t distinct = 1;
  for (size_t i = 1; i < across.size(); ++i) {
    distinct += across[i] - across[i - 1] > 1e-3;
    if (across[i] > across[i - 1]) smallest_m = std::min(smallest_m, across[i] - across[i - 1]);
  }
  CHECK(distinct > 19000);
}
