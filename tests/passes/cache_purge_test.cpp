// SPDX-License-Identifier: Apache-2.0
// The entries that may answer, and those that are removed, on every kind of table: position, precision, receivers and
// instances that move, and cache_purge by age. Hits are given, not traced.
#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "passes/cache_forest.hpp"
#include "passes/thesis_cache.hpp"

using namespace wavetracer;
using namespace wavetracer::device;
using namespace wavetracer::test;

namespace {

std::vector<wt_exact_surface> of_the_environment(size_t count) {
  std::vector<wt_exact_surface> surfaces(count);
  for (wt_exact_surface& surface : surfaces) surface.instance = WT_NONE;
  return surfaces;
}

CacheConfig all_config(CacheKind kind) {
  CacheConfig config = small_cache(kind);
  config.scope = "all";
  config.hit_point = "cached";
  config.division = 100000;
  config.buffer_size = 1 << 16;
  config.hash_method = 1;
  return config;
}

}  // namespace

TEST_CASE("precision: an entry answers while origin and direction are within the residual, by the L1 distance") {
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "open", "concurrent"})) {
    CAPTURE(kind);
    CacheConfig config = small_cache(kind);
    config.purge = "precision";
    config.residual_value = 0.1;
    config.hit_point = "cached";
    Cache cache(config);
    const CachedRay ray{{1, 2, 3}, {0.6f, 0.8f, 0}, 3, 7, 0};
    const Hit hit{4, 5, 6};
    cache.put(std::span(&ray, 1), std::span(&hit, 1));
    cache.set_since(0, 9);  // does not matter here
    cache.counters();
    std::vector<CachedRay> near(3, ray);
    near[0].origin = {1.03f, 1.97f, 3.03f};  // 0.09
    near[1].origin = {1.04f, 1.96f, 3.04f};  // 0.12, each component below 0.1
    near[2].origin = {1.09f, 2, 3};
    near[2].direction = {0.61f, 0.792f, 0};  // 0.108 together
    CHECK(cache.find_one_by_one(near) == std::vector{true, false, false});
    CHECK(cache.counters().stale == 2);
    CHECK(cache.find(std::span(near).first(1)).hits[0] == hit);
  }
}

TEST_CASE("scope all: a receiver must be within its radius of the cached segment, by the distance in space") {
  // Segments of 10 m run along x, each with a receiver at its middle when it was stored.
  const std::vector<Float3> now{{5, 0, 0},  {5, 0.99f, 0}, {5, 5, 0},  {5, 0.9f, 0.9f}, {9.5f, 0, 0},
                                {12, 0, 0}, {-0.9f, 0, 0}, {5, 0, -3}, {-2, 0, 0},      {5, 0.7f, 0.7f}};
  const std::vector<bool> within{true, true, false, false, true, false, true, false, false, true};
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "open", "concurrent"})) {
    CAPTURE(kind);
    Cache cache(all_config(kind));
    std::vector<CachedRay> rays;
    std::vector<Hit> hits;
    std::vector<uint32_t> receivers;
    std::vector<float> centres;
    for (uint32_t i = 0; i < now.size(); ++i) {
      rays.push_back({{0, 0, 0}, {1, 0, 0}, 3, i, 0});
      hits.push_back({10, i, 0});
      receivers.push_back(i);
      centres.insert(centres.end(), {now[i][0], now[i][1], now[i][2], 0});
    }
    cache.scene.exact_surfaces = context().buffer(of_the_environment(4), "exact surfaces");
    cache.movement.receivers = context().buffer(centres, "receivers");
    cache.movement.radius_m = 1;
    cache.put(rays, hits, receivers);
    cache.counters();
    const Answers answers = cache.find(rays);
    CHECK(answers.found == within);
    CHECK(cache.counters().stale == 5);
    for (uint32_t i = 0; i < now.size(); ++i) CHECK(answers.receptions[i] == (within[i] ? i : WT_NONE));
    // They are purged for good, even if the receiver comes back; traced again, they take their place.
    for (size_t i = 0; i < now.size(); ++i) centres[4 * i + 1] = centres[4 * i + 2] = 0;
    cache.movement.receivers.write(centres);
    CHECK(cache.find(rays).found == within);
    cache.put(rays, hits);
    const wt_cache_counters counts = cache.counters();
    CHECK(counts.replaced == 5);
    CHECK(counts.duplicates == 5);
    CHECK(cache.find(rays).count() == rays.size());  // those five had no receiver
  }
  // The thesis keeps the third, whose x agrees, by algorithm 4, and the fourth, in the corner of the cube, by C.3.
  const thesis::Point point{5, 0, 0};
  CHECK(thesis::withinByAlgorithm4({5, 5, 0}, point, 1));
  CHECK(thesis::withinByListing({5, 0.9f, 0.9f}, point, 1));
}

TEST_CASE("scope all: what was left or met must not have moved since") {
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "open", "concurrent"})) {
    CAPTURE(kind);
    Cache cache(all_config(kind));
    std::vector<wt_exact_surface> surfaces = of_the_environment(6);
    surfaces[2].instance = surfaces[3].instance = 0;
    surfaces[4].instance = surfaces[5].instance = 1;
    cache.scene.exact_surfaces = context().buffer(surfaces, "exact surfaces");
    const std::vector<CachedRay> rays{{{0, 0, 0}, {1, 0, 0}, 0, 1, 0}, {{0, 0, 0}, {1, 0, 0}, 0, 2, 0},
                                      {{0, 0, 0}, {1, 0, 0}, 2, 3, 0}, {{0, 0, 0}, {1, 0, 0}, 4, 4, 0},
                                      {{0, 0, 0}, {1, 0, 0}, 0, 5, 0}, {{0, 0, 0}, {1, 0, 0}, 0x80000000u, WT_NONE, 0}};
    const std::vector<Hit> hits{{1, 1, 1}, {1, 2, 3}, {1, 3, 1}, {1, 4, 5}, {}, {1, 6, 1}};
    cache.now = 7;
    cache.put(rays, hits);
    cache.now = 8;
    cache.movement.instance_since = context().buffer(std::vector<uint32_t>{8, 7}, "instances moved");
    cache.counters();
    CHECK(cache.find(rays).found == std::vector{true, false, false, true, true, true});
    CHECK(cache.counters().stale == 2);
    cache.put(rays, hits);
    CHECK(cache.counters().replaced == 2);
    CHECK(cache.find(rays).count() == 6);
  }
}

TEST_CASE("entries that answer are touched where that is asked for, and purge goes by it") {
  for (const CacheKind kind : std::to_array<CacheKind>({"open", "concurrent"})) {
    CAPTURE(kind);
    CacheConfig config = small_cache(kind);
    config.hit_point = "cached";
    config.division = 100000;  // each ray has its own key
    Cache cache(config, 2);
    const std::vector<CachedRay> rays = random_rays(5, 400, 2);
    cache.put(rays, std::vector<Hit>(rays.size(), {1, 1, 1}));
    const wt_cache_counters put = cache.counters();
    const size_t kept = put.stored - put.replaced;
    CHECK(kept > 350);
    cache.now = 4;
    cache.find(rays);  // untouched
    cache.touch = true;
    const std::span<const CachedRay> half = std::span(rays).first(200);
    std::vector<CachedRay> touched;
    const std::vector<bool> found = cache.find(half).found;
    for (size_t i = 0; i < half.size(); ++i)
      if (found[i]) touched.push_back(half[i]);
    cache.touch = false;
    CHECK(touched.size() > 150);
    cache.counters();
    cache.purge(4);
    CHECK(cache.counters().evicted == kept - touched.size());
    CHECK(cache.find(touched).count() == touched.size());  // they share no slot
    CHECK(cache.find(std::span(rays).subspan(200)).count() == 0);
    cache.put(rays, std::vector<Hit>(rays.size(), {2, 2, 2}));
    if (kind == "concurrent") CHECK(cache.find(rays).count() == rays.size());
  }
}

TEST_CASE("cache_purge clears a chained region when more than half of it is old") {
  Cache cache(chained(2048), 2);
  const std::vector<CachedRay> early = random_rays(61, 300, 2), late = random_rays(62, 100, 2);
  cache.put(early, hits_of(300));
  cache.now = 2;
  cache.put(late, hits_of(100));
  cache.touch = true;
  std::vector<CachedRay> touched;  // 100 of 150 rays in region 0
  for (uint32_t i = 0; i < 200; i += 2) touched.push_back(early[i]);
  CHECK(cache.find(touched).count() == 100);
  cache.touch = false;
  cache.purge(1);
  CHECK(cache.counters().evicted == 0);
  CHECK(cache.find(early).count() == 300);
  cache.purge(2);
  // Region 0: 50 of 200 are old; region 1: 150 of 200.
  CHECK(cache.counters().evicted == 200);
  CHECK(cache.find(touched).count() == 100);
  CHECK(cache.find(early).count() == 150);
  CHECK(cache.find(late).count() == 50);
  CHECK(cache.table.used.read() == std::vector<uint32_t>{200, 0});
}
