// SPDX-License-Identifier: Apache-2.0
// Compares trace.reception = "sphere" with closed forms (rays caught, lengths, paths lost, false paths), and with a ray
// cache against without. Directions are independent, so counts are binomial.
#include <array>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "passes/triangles.hpp"
#include "simulation/run.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

Config sphere_config(const SceneFile& file, const Points& transmitters, const Points& receivers, uint64_t rays,
                     uint32_t max_depth, double radius_m) {
  Config config = config_of(file.path(), transmitters, receivers, rays, max_depth);
  config.trace.reception = "sphere";
  config.trace.sphere_radius_m = radius_m;
  config.trace.directions = "random";
  return config;
}

// A scene must contain something; this is far from everything.
const Quad pebble{{-1, -1, -900}, {2, 0, 0}, {0, 2, 0}};

double length_m(const Paths& paths, size_t i) { return paths.delay_s[i] * speed_of_light; }

// Returns the number of rays that meet 1 m^2 of a plane across the path, at this distance from the transmitter or its
// image.
double density(uint64_t rays, double distance_m) {
  return static_cast<double>(rays) / (4 * std::numbers::pi * distance_m * distance_m);
}

CacheConfig cache_of(CacheKind kind, CacheScope scope, CacheKey key) {
  CacheConfig cache;
  cache.kind = kind;
  cache.scope = scope;
  cache.key = key;
  cache.hit_point = "cached";
  return cache;
}

// Transmitter, launch index and segment of everything that is received, where all rays leave waypoints.
using Segments = std::set<std::tuple<uint32_t, uint64_t, uint32_t>>;

Segments received(const WaypointRows& rows) {
  Segments out;
  for (size_t i = 0; i < rows.size(); ++i)
    if (rows.kind[i] == WaypointKind::hit) out.emplace(rows.tx[i], rows.sample[i], rows.depth[i]);
  return out;
}

Segments common(const Segments& a, const Segments& b) {
  Segments out;
  std::ranges::set_intersection(a, b, std::inserter(out, out.end()));
  return out;
}

}  // namespace

TEST_CASE("free space: a sphere at d catches (1 - cos asin(R / d)) / 2 of the rays, and the path is d long") {
  const SceneFile file({pebble});
  constexpr uint64_t rays = 300000;
  for (const auto& [d, radius_m] : {std::pair{10.0, 1.0}, {50.0, 4.0}, {200.0, 30.0}}) {
    CAPTURE(d);
    const glm::dvec3 tx{3, -2, 5}, rx = tx + d * glm::normalize(glm::dvec3{2, -1, 0.7});
    const FrameResult frame = run(sphere_config(file, {tx}, {rx}, rays, 0, radius_m));
    const double share = (1 - std::cos(std::asin(radius_m / d))) / 2;
    const double expected = static_cast<double>(rays) * share;
    CHECK(std::abs(static_cast<double>(frame.counts.receptions) - expected) < 4 * std::sqrt(expected * (1 - share)));
    REQUIRE(frame.paths.size() == 1);
    CHECK(frame.paths.depth[0] == 0);
    CHECK(length_m(frame.paths, 0) == doctest::Approx(d).epsilon(1e-12));
  }
}

TEST_CASE("one mirror: paths are too long by what their rays miss the receiver by, and so many are lost") {
  const SceneFile file({{{-3000, -3000, 0}, {6000, 0, 0}, {0, 6000, 0}}});
  const glm::dvec3 tx{0, 0, 6}, mirrored{0, 0, -6};
  Points receivers;
  for (int i = 0; i < 300; ++i) {
    const double angle = 2.399963 * i, far = 20 + 0.1 * i;  // a sunflower: at least 1.5 m from each other
    receivers.push_back({far * std::cos(angle), far * std::sin(angle), 4 + 10 * std::fmod(0.618 * i, 1.0)});
  }
  // From a few rays per path to one in some paths.
  using Case = std::pair<uint64_t, double>;
  for (const auto& [rays, radius_m] : {Case{1000000, 1}, Case{60000, 1}, Case{10000, 1}, Case{10000, 0.25}}) {
    CAPTURE(rays);
    CAPTURE(radius_m);
    const Paths paths = run(sphere_config(file, {tx}, receivers, rays, 1, radius_m)).paths;
    double found = 0, found_expected = 0, found_variance = 0, excess = 0, count = 0, worst = 0;
    for (size_t i = 0; i < paths.size(); ++i) {
      if (paths.depth[i] != 1) continue;
      const glm::dvec3 p = paths.vertex_position_m[paths.vertex_offset[i]], rx = receivers[paths.rx[i]];
      const double exact_m = glm::distance(mirrored, rx), r1 = glm::distance(mirrored, p);
      // The straight ray from the image passes the receiver at this distance.
      const glm::dvec3 d = (p - mirrored) / r1;
      const double b = glm::distance(rx, mirrored + glm::dot(rx - mirrored, d) * d);
      const double expected_m = r1 + std::sqrt(std::pow(std::sqrt(exact_m * exact_m - b * b) - r1, 2) + b * b);
      worst = std::max(worst, std::abs(length_m(paths, i) - expected_m));
      CHECK(std::abs(p.z) < 1e-9);
      CHECK(b < radius_m + 1e-4);
      CHECK(length_m(paths, i) > exact_m - 1e-9);
      // The nearest of rays of this density passes at b, of which b^2 is exponential, cut off at R^2.
      const double rate = std::numbers::pi * density(rays, exact_m), cut = rate * radius_m * radius_m;
      const double mean = 1 / rate - radius_m * radius_m * std::exp(-cut) / (1 - std::exp(-cut));
      const double r2 = exact_m - r1;
      excess += (length_m(paths, i) - exact_m) / (mean / 2 * (1 / r2 - 1 / exact_m));
      ++count;
      ++found;
    }
    for (const glm::dvec3& rx : receivers) {
      const double cut = std::numbers::pi * density(rays, glm::distance(mirrored, rx)) * radius_m * radius_m;
      found_expected += 1 - std::exp(-cut);
      found_variance += std::exp(-cut) * (1 - std::exp(-cut));
    }
    CHECK(worst < 1e-9);
    CHECK(std::abs(found - found_expected) < 4 * std::sqrt(found_variance) + 0.5);
    if (count >= 20) CHECK(std::abs(excess / count - 1) < 4 / std::sqrt(count));
    if (rays == 1000000) CHECK(found > 295);
    if (rays == 10000 && radius_m == 0.25) CHECK(found < 60);
  }
}

TEST_CASE("behind the edge of a screen a sphere hears what it should not, as far in as its radius") {
  const SceneFile file({{{0, -60, -60}, {0, 60, 0}, {0, 0, 120}}});
  const glm::dvec3 tx{-10, 0, 0.3};
  // Receivers are 1 m and 3 m inside the shadow, and in the light.
  const Points receivers{{10, -1, 0}, {10, -3, 0}, {10, 1, 0}};
  const Paths exact = run(config_of(file.path(), {tx}, receivers, 100000, 1)).paths;
  CHECK(count_by_depth(exact, 0, 1)[0] == 0);
  CHECK(count_by_depth(exact, 1, 1)[0] == 0);
  CHECK(count_by_depth(exact, 2, 1)[0] == 1);
  const Paths heard = run(sphere_config(file, {tx}, receivers, 100000, 1, 2)).paths;
  CHECK(count_by_depth(heard, 0, 1)[0] == 1);  // spurious
  CHECK(count_by_depth(heard, 1, 1)[0] == 0);
  CHECK(count_by_depth(heard, 2, 1)[0] == 1);
}

TEST_CASE("many transmitters and two receivers: paths of wanted links and of no other") {
  const SceneFile file({{{-100, -100, 0}, {200, 0, 0}, {0, 200, 0}}});
  Points transmitters;
  for (int i = 0; i < 20; ++i) transmitters.push_back({-19.0 + 2 * i, 3, 4});
  Config config = sphere_config(file, transmitters, {{-12, 0, 2}, {12, 0, 3}}, 20000, 1, 1);
  config.links.max_distance_m = 15;
  const FrameResult frame = run(config);
  std::set<std::tuple<uint32_t, uint32_t, uint32_t>> found, expected;
  for (size_t i = 0; i < frame.paths.size(); ++i)
    found.emplace(frame.paths.tx[i], frame.paths.rx[i], frame.paths.depth[i]);
  for (const Link& link : frame.world.links)
    for (uint32_t depth = 0; depth <= 1; ++depth) expected.emplace(link.tx, link.rx, depth);
  CHECK(frame.world.links.size() > 20);
  CHECK(frame.world.links.size() < 40);
  CHECK(found == expected);
  CHECK(frame.paths.size() == expected.size());
}

TEST_CASE("a box: of the exact paths, spheres find those that a ray of that density meets") {
  const glm::dvec3 size{8, 5, 3}, tx{1.37, 2.21, 1.55};
  const SceneFile file(reference::box_walls({0, 0, 0}, size));
  Points receivers;
  Random random(4);
  for (int i = 0; i < 12; ++i)
    receivers.push_back({random.between(0.5, 7.5), random.between(0.5, 4.5), random.between(0.5, 2.5)});
  using Key = std::pair<uint32_t, std::vector<uint32_t>>;
  const auto keys = [](const Paths& paths) {
    std::map<Key, double> out;  // lengths
    for (size_t i = 0; i < paths.size(); ++i) {
      const auto* first = paths.vertex_surface.data() + paths.vertex_offset[i];
      out[{paths.rx[i], {first, first + paths.depth[i]}}] = length_m(paths, i);
    }
    return out;
  };
  const auto exact = keys(run(config_of(file.path(), {tx}, receivers, 300000, 3)).paths);
  REQUIRE(exact.size() == 12 * 63);
  double recall_before = 0;
  using Case = std::pair<uint64_t, double>;
  for (const auto& [rays, radius_m] : {Case{20000, 0.1}, Case{20000, 0.2}, Case{80000, 0.2}}) {
    CAPTURE(rays);
    CAPTURE(radius_m);
    const auto heard = keys(run(sphere_config(file, {tx}, receivers, rays, 3, radius_m)).paths);
    double found = 0, expected = 0, variance = 0;
    for (const auto& [key, metres] : exact) {
      const double lost = std::exp(-std::numbers::pi * density(rays, metres) * radius_m * radius_m);
      expected += 1 - lost;
      variance += lost * (1 - lost);
      found += heard.contains(key);
    }
    // If a path passes an edge closer than the radius, a part of its rays takes another sequence.
    CHECK(std::abs(found - expected) < 4 * std::sqrt(variance) + 0.01 * static_cast<double>(exact.size()));
    const double recall = found / static_cast<double>(exact.size());
    CHECK(recall > recall_before);
    recall_before = recall;
  }
  CHECK(recall_before > 0.95);
}

TEST_CASE("spheres hear the same, whatever the order and the batches of the rays") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {8, 5, 3}));
  Config config =
      sphere_config(file, {{1.37, 2.21, 1.55}, {5, 1, 2}}, {{6.13, 3.42, 0.87}, {2.9, 0.61, 2.3}}, 5000, 3, 0.5);
  const FrameResult plain = run(config);
  CHECK(plain.paths.size() > 200);
  config.trace.batch_rays = 777;
  const FrameResult batches = run(config);
  CHECK(identical(batches.paths, plain.paths));
  CHECK(batches.counts.receptions == plain.counts.receptions);
  config.order.method = "morton";
  config.order.each_depth = true;
  CHECK(identical(run(config).paths, plain.paths));
}

TEST_CASE("cache.scope = \"all\", nothing moves: a second frame receives from the cache what the first one did") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {8, 5, 3}));
  for (const uint32_t max_depth : {2u, 3u})
    for (const CacheKind kind : std::to_array<CacheKind>({"chained", "concurrent"})) {
      CAPTURE(max_depth);
      CAPTURE(kind);
      Config config = sphere_config(file, {{1.37, 2.21, 1.55}, {5, 1, 2}}, {{6.13, 3.42, 0.87}}, 10000, max_depth, 0.5);
      const FrameResult plain = run(config);
      config.cache = cache_of(kind, "all", "quantised");
      Simulation simulation(config);
      const FrameResult first = simulation.run_frame(0), second = simulation.run_frame(0);
      CHECK(first.counts.receptions > 500);
      CHECK(identical(second.paths, first.paths));
      CHECK(second.counts.receptions == first.counts.receptions);
      CHECK(second.cache.hits == second.cache.lookups);
      CHECK(second.cache.lookups == 2 * 10000 * (max_depth + 1));
      CHECK(second.cache.stale == 0);
      // A ray that goes to and fro leaves a wall in one direction twice, and the cache answers the second time with the
      // first.
      CHECK((first.cache.hits > 0) == (max_depth > 2));
      if (first.cache.hits > 0) continue;
      CHECK(identical(first.paths, plain.paths));
      CHECK(first.counts.receptions == plain.counts.receptions);
    }
}

TEST_CASE("cache.scope = \"all\": an entry keeps one receiver of those that its segment passes") {
  const SceneFile file(reference::box_walls({0, 0, 0}, {8, 5, 3}));
  Config config = sphere_config(file, {{1.37, 2.21, 1.55}}, {{6.13, 3.42, 0.87}, {6.13, 3.92, 0.87}}, 5000, 2, 0.5);
  config.output.waypoints = *config.trace.rays;
  config.cache = cache_of("concurrent", "all", "quantised");
  Simulation simulation(config);
  const FrameResult first = simulation.run_frame(0), second = simulation.run_frame(0);
  const Segments segments = received(first.waypoints);
  CHECK(first.counts.receptions > segments.size() + 50);
  CHECK(received(second.waypoints) == segments);
  CHECK(second.counts.receptions == segments.size());
}

TEST_CASE("a receiver that moves: what a cache of everything goes on to receive, and one of the static scene does") {
  const SceneFile file({pebble});
  Config config = sphere_config(file, {{0, 0, 5}}, {}, 50000, 0, 2);
  config.output.waypoints = *config.trace.rays;
  config.vehicle_types = {{"passenger", "none"}};
  config.tracks = {{"walker", "passenger", {{0, 20, 0, 5}, {4, 20, 6, 5}}}};  // 1.5 m per frame
  config.mounts = {{.name = "ear", .role = "receiver"}};
  config.time.step_s = 1;
  const std::vector<uint32_t> frames{0, 1, 4};
  const auto heard = [&](CacheKind kind, CacheScope scope, CacheKey key) {
    config.cache = cache_of(kind, scope, key);
    Simulation simulation(config);
    std::vector<FrameResult> out;
    for (const uint32_t frame : frames) out.push_back(simulation.run_frame(frame));
    return out;
  };
  const std::vector<FrameResult> plain = heard("none", "static", "exact");
  std::vector<Segments> there;
  for (const FrameResult& frame : plain) there.push_back(received(frame.waypoints));
  REQUIRE(there[0].size() > 50);
  REQUIRE(there[2].size() > 50);
  REQUIRE(common(there[0], there[1]).size() > 20);
  REQUIRE(common(there[0], there[2]).empty());
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "open", "concurrent"})) {
    CAPTURE(kind);
    const std::vector<FrameResult> fixed = heard(kind, "static", "exact");
    for (size_t i = 0; i < frames.size(); ++i) {
      CHECK(received(fixed[i].waypoints) == there[i]);
      CHECK(identical(fixed[i].paths, plain[i].paths));
    }
    CHECK(fixed[2].cache.hits > *config.trace.rays / 2);
    if (kind == "open") continue;  // rays that share a slot replace each other
    // Segments that still pass the receiver remain right; those that no longer pass it are traced again; those that
    // newly pass it are answered with the earlier result (fault 11), so the receiver does not receive them at its new
    // place.
    const std::vector<FrameResult> all = heard(kind, "all", "quantised");
    CHECK(received(all[0].waypoints) == there[0]);
    CHECK(received(all[1].waypoints) == common(there[0], there[1]));
    CHECK(all[1].cache.stale == there[0].size() - common(there[0], there[1]).size());
    CHECK(all[1].cache.hits == *config.trace.rays - all[1].cache.stale);
    CHECK(received(all[2].waypoints).empty());
    CHECK(all[2].paths.size() == 0);
    CHECK(plain[2].paths.size() == 1);
  }
}
