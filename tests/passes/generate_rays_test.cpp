// generate_rays: launch index to direction is one pure function, the same on the device as on the host.
// Equal solid angles, unit length, and neighbours in index that are neighbours on the sphere.
#include "passes/generate_rays.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <string>

#include "passes/triangles.hpp"
#include "wavetracer/device/directions.h"
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

// What a ray of this number in its launch begins as.
uint32_t numbered(uint32_t root, uint64_t number) {
  return root | static_cast<uint32_t>(number & 3) << WT_QUARTER_SHIFT;
}

GenerateRays generator(Directions map, uint64_t n) {
  return GenerateRays(context(), LaunchDirections(map, n, launch_seed), launch_heights());
}

// What the maps take: the step or the seed, and the cells of hilbert: the fewest faces and levels that hold n rays.
struct Launch {
  uint64_t parameter;
  unsigned level = 0, faces = 3;

  Launch(Directions map, uint64_t n) : parameter(map == "random" ? launch_seed : ~uint64_t{0} / n) {
    while ((uint64_t{12} << (2 * level)) < n) ++level;
    while ((uint64_t{faces} << (2 * level)) < n) ++faces;
  }

  Float3 direction(Directions map, uint64_t i) const {
    const auto function = map == "horizon"     ? device::wt_direction_horizon
                          : map == "hilbert"   ? device::wt_direction_hilbert
                          : map == "fibonacci" ? device::wt_direction_fibonacci
                                               : device::wt_direction_random;
    const device::wt_direction d = function(i, parameter, level, faces, height_tables().data(), height_table_size);
    return {d.x, d.y, d.z};
  }
};

std::vector<Float3> host_directions(Directions map, uint64_t n) {
  const Launch launch(map, n);
  std::vector<Float3> out;
  for (uint64_t i = 0; i < n; ++i) out.push_back(launch.direction(map, i));
  return out;
}

// In units of the sphere's area over n rays' shares: z from -1 to 1, then the azimuth in turns.
std::pair<double, double> cylinder(const Float3& d) {
  const double turn = std::atan2(double{d[1]}, double{d[0]}) / (2 * std::numbers::pi);
  return {(1 - double{d[2]}) / 2, turn < 0 ? turn + 1 : turn};
}

double mean_step_rad(const std::vector<Float3>& directions) {
  double sum = 0;
  for (size_t i = 1; i < directions.size(); ++i) {
    const glm::dvec3 a = to_double(directions[i - 1]), b = to_double(directions[i]);
    sum += std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
  }
  return sum / static_cast<double>(directions.size() - 1);
}

// Pearson's statistic of the counts in bands x turns bins of equal area.
double chi_square(const std::vector<Float3>& directions, size_t bands, size_t turns) {
  std::vector<double> counts(bands * turns, 0);
  for (const Float3& d : directions) {
    const auto [height, turn] = cylinder(d);
    const size_t band = std::min(static_cast<size_t>(height * static_cast<double>(bands)), bands - 1);
    counts[band * turns + std::min(static_cast<size_t>(turn * static_cast<double>(turns)), turns - 1)] += 1;
  }
  const double expected = static_cast<double>(directions.size()) / static_cast<double>(counts.size());
  double sum = 0;
  for (const double count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
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
      const Launch launch(map, n);
      size_t different = 0;
      for (uint32_t i = 0; i < n; ++i)
        different +=
            rays[i] != Ray{{1.5f, -2.25f, 0.125f}, launch.direction(map, i), WT_NONE, numbered(WT_ROOT | 3, i)};
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
    const Launch launch(map, n);
    size_t different = 0;
    for (uint32_t i = 0; i < 100; ++i) different += rays[i].direction != launch.direction(map, n - 100 + i);
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
      const Launch launch(map, n);
      size_t different = 0;
      for (uint32_t k = 0; k < count; ++k)
        different += rays[k] != Ray{{1, 2, 3},
                                    launch.direction(map, 7 + stride * k),
                                    source,
                                    numbered(WT_ROOT | 2, (7 + stride * k) / stride)};
      CHECK(different == 0);
    }
}

TEST_CASE("launchers that share a launch get the rays that each gets alone") {
  constexpr uint64_t n = 10'000;
  constexpr uint32_t count = 160;  // of every one
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
  const Launch launch("hilbert", n);
  size_t different = 0;
  for (uint32_t k = 0; k < count; ++k)
    different +=
        rays[k] !=
        Ray{{4, 5, 6}, launch.direction("hilbert", first + order[k]), source, numbered(WT_ROOT | 1, first + order[k])};
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
      const device::wt_direction d = (map == "horizon" ? device::wt_direction_horizon : device::wt_direction_hilbert)(
          cell[i], directions.parameter, directions.level, directions.faces, height_tables().data(),
          from * height_table_size);
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

TEST_CASE("directions have unit length") {
  for (const Directions map : maps) {
    CAPTURE(map);
    double worst = 0;
    for (const Float3& d : host_directions(map, 100000))
      worst = std::max(worst, std::abs(glm::length(to_double(d)) - 1));
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("equal solid angles: chi-square over 192 bins of equal area") {
  // Of independent samples the statistic has mean 191 and standard deviation 19.5; its 99.9 % point is 257.
  CHECK(chi_square(host_directions("random", 100000), 12, 16) < 257);
  CHECK(chi_square(host_directions("random", 100000), 12, 16) > 135);  // the 0.1 % point: suspiciously even below
  // Even maps are far below it: a bin is off by the cells on its border at most.
  for (const uint64_t n : {uint64_t{3072}, uint64_t{100000}, uint64_t{65537}}) {
    CAPTURE(n);
    CHECK(chi_square(host_directions("hilbert", n), 12, 16) < 20);
    CHECK(chi_square(host_directions("fibonacci", n), 12, 16) < 20);
  }
}

TEST_CASE("hilbert: each of 3 x 32 x 32 cells of equal area has one of 3,072 rays") {
  std::set<std::pair<int, int>> cells;
  for (const Float3& d : host_directions("hilbert", 3072)) {
    const auto [height, turn] = cylinder(d);
    cells.emplace(static_cast<int>(height * 32), static_cast<int>(turn * 96));
  }
  CHECK(cells.size() == 3072);
}

TEST_CASE("hilbert and fibonacci: heights are evenly spread, and no two rays are the same") {
  constexpr uint64_t n = 10240;  // ten faces of 1,024 cells, whose heights are steps of 1 / 1,024
  for (const Directions map : std::to_array<Directions>({"hilbert", "fibonacci"})) {
    CAPTURE(map);
    std::vector<Float3> directions = host_directions(map, n);
    std::vector<double> heights;
    for (const Float3& d : directions) heights.push_back(cylinder(d).first);
    std::sort(heights.begin(), heights.end());
    double worst = 0;  // the star discrepancy in one dimension
    for (size_t i = 0; i < heights.size(); ++i)
      worst = std::max(worst, std::abs(heights[i] - (static_cast<double>(i) + 0.5) / n));
    CHECK(worst < 1.0 / 1024);
    std::sort(directions.begin(), directions.end());
    CHECK(std::adjacent_find(directions.begin(), directions.end()) == directions.end());
  }
}

TEST_CASE("hilbert: consecutive rays are neighbours on the sphere") {
  // Neighbours of a square lattice are sqrt(4 pi / n) apart; offsets inside the cells and their stretch towards the
  // poles cost about a factor of two, whatever n.
  for (const uint64_t n : {uint64_t{3072}, uint64_t{50000}, uint64_t{200000}}) {
    CAPTURE(n);
    const double lattice = std::sqrt(4 * std::numbers::pi / static_cast<double>(n));
    CHECK(mean_step_rad(host_directions("hilbert", n)) < 2.5 * lattice);
    CHECK(mean_step_rad(host_directions("fibonacci", n)) > 10 * lattice);  // golden-ratio turns: far apart
  }
}

TEST_CASE("the Hilbert curve visits every cell once, by unit steps") {
  for (const unsigned level : {1u, 2u, 5u, 8u}) {
    CAPTURE(level);
    std::set<std::pair<uint32_t, uint32_t>> visited;
    uint32_t before_x = 0, before_y = 0, jumps = 0;
    for (uint32_t i = 0; i < 1u << (2 * level); ++i) {
      uint32_t x, y;
      device::wt_hilbert_cell(i << (32 - 2 * level), &x, &y);
      x >>= 16 - level;
      y >>= 16 - level;
      visited.emplace(x, y);
      const int step = std::abs(static_cast<int>(x - before_x)) + std::abs(static_cast<int>(y - before_y));
      jumps += i > 0 && step != 1;
      before_x = x;
      before_y = y;
    }
    CHECK(visited.size() == 1u << (2 * level));
    CHECK(jumps == 0);
  }
}
