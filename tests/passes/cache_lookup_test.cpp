// cache_lookup, cache_store and cache_purge on every kind of table: rays of a room against a model on the host, and the
// rules of what may answer: position, precision, receivers and instances that move.
#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "passes/cached_rays.hpp"
#include "passes/thesis_cache.hpp"
#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::device;
using namespace wavetracer::test;

namespace {

CacheConfig config_of(const std::string& kind, const std::string& key = "quantised") {
  CacheConfig config;
  config.kind = kind;
  config.key = key;
  config.buffer_size = 3 * 4096;
  config.division = 16;
  config.readers_number = 1000;
  return config;
}

std::vector<CachedRay> rays_in_room(uint32_t seed, size_t count, uint32_t regions) {
  Random random(seed);
  std::vector<CachedRay> rays;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t left = random.below(4) ? random.below(12) : WT_NONE;
    const uint32_t surface = left == WT_NONE ? WT_NONE : left / 2;
    rays.push_back({to_float(random.in_cube(4)), to_float(random.direction()), surface, left, random.below(regions)});
  }
  return rays;
}

std::vector<Hit> traced(const DeviceScene& scene, const std::vector<CachedRay>& rays) {
  std::vector<Ray> plain;
  for (const CachedRay& ray : rays) plain.push_back({ray.origin, ray.direction});
  return trace(scene, TraceShape::bvh2, plain);
}

uint64_t cells_of(const CachedRay& ray, uint32_t division) {
  return wt_cache_cells(ray.direction[0], ray.direction[1], ray.direction[2], division);
}

using Key = std::tuple<uint32_t, uint32_t, uint64_t>;
Key key_of(const CachedRay& ray, uint32_t division) { return {ray.region, ray.left, cells_of(ray, division)}; }

// Only the first ray of each key.
std::vector<CachedRay> distinct(const std::vector<CachedRay>& rays, uint32_t division) {
  std::map<Key, CachedRay> first;
  for (const CachedRay& ray : rays) first.try_emplace(key_of(ray, division), ray);
  std::vector<CachedRay> out;
  for (const auto& [key, ray] : first) out.push_back(ray);
  return out;
}

std::vector<wt_exact_surface> of_the_environment(size_t count) {
  std::vector<wt_exact_surface> surfaces(count);
  for (wt_exact_surface& surface : surfaces) surface.instance = WT_NONE;
  return surfaces;
}

CacheConfig all_config(const std::string& kind) {
  CacheConfig config = config_of(kind);
  config.scope = "all";
  config.hit_point = "cached";
  config.division = 100000;
  return config;
}

}  // namespace

TEST_CASE("what was stored answers rays of its key, at their own points, and nothing else does") {
  // Half of a room: many rays leave it.
  std::vector<Corners> triangles = room(Room::box, 1, 5);
  triangles.resize(6);
  const Scene scene = scene_by_loader(triangles);
  const DeviceScene uploaded = make_device_scene(context(), scene, false);
  for (const std::string kind : {"chained", "open", "concurrent"}) {
    CAPTURE(kind);
    CacheConfig config = config_of(kind);
    config.division = 8;
    Cache cache(config, 3, 6, 12);
    cache.scene.surfaces = uploaded.surfaces;
    const std::vector<CachedRay> rays = distinct(rays_in_room(1, 1500, 3), config.division);
    const std::vector<Hit> hits = traced(uploaded, rays);
    cache.put(rays, hits);
    const wt_cache_counters counts = cache.counters();
    CHECK(counts.stored == rays.size());
    std::map<Key, uint32_t> model;
    for (uint32_t i = 0; i < rays.size(); ++i) model[key_of(rays[i], config.division)] = i;

    const std::vector<CachedRay> others = rays_in_room(2, 2000, 3);
    const Answers answers = cache.find(others);
    size_t wrong = 0, close_calls = 0, replaced = 0;
    for (uint32_t i = 0; i < others.size(); ++i) {
      const auto known = model.find(key_of(others[i], config.division));
      if (known == model.end()) {
        wrong += answers.found[i];
        continue;
      }
      const Hit& stored = hits[known->second];
      if (stored.missed()) {
        wrong += kind == "open" ? answers.found[i] && !answers.hits[i].missed()
                                : !answers.found[i] || !answers.hits[i].missed();
        continue;
      }
      const Surface& surface = scene.surfaces[stored.surface];
      const glm::dvec3 o = to_double(others[i].origin), d = to_double(others[i].direction);
      const double t = (surface.offset_m - glm::dot(surface.normal, o)) / glm::dot(surface.normal, d);
      const glm::dvec3 p = o + t * d;
      double inside = t;  // by how much
      for (int k = 0; k < 3; ++k)
        inside = std::min({inside, p[k] - surface.lower[k] + 1e-3, surface.upper[k] + 1e-3 - p[k]});
      if (std::abs(inside) < 1e-4) {
        ++close_calls;
      } else if (inside < 0) {
        wrong += answers.found[i];
        ++replaced;
      } else if (answers.found[i]) {
        wrong += answers.hits[i].surface != stored.surface || answers.hits[i].primitive != stored.primitive;
        wrong += std::abs(answers.hits[i].t - t) > 1e-5 * (1 + t);
      } else {
        wrong += kind != "open";  // where other keys lie in the same slots
      }
      const Ray& after = answers.rays[i];
      wrong += after.origin != others[i].origin || after.direction != others[i].direction;
    }
    CHECK(wrong == 0);
    CHECK(close_calls < 10);
    CHECK(replaced > 50);
    CHECK(answers.count() > 200);
  }
}

TEST_CASE("exact keys answer the very same rays alone, with the very same hits") {
  for (const std::string kind : {"chained", "open", "concurrent"}) {
    CAPTURE(kind);
    CacheConfig config = config_of(kind, "exact");
    config.buffer_size = 1 << 16;
    Cache cache(config, 1, 6, 12);
    std::vector<CachedRay> rays = rays_in_room(3, 1000, 1);
    std::vector<Hit> hits;
    for (uint32_t i = 0; i < rays.size(); ++i)
      hits.push_back(i % 5 ? Hit{0.1f * static_cast<float>(i), i, i} : Hit{});
    cache.put(rays, hits);
    const size_t stored = cache.counters().stored;
    Answers answers = cache.find(rays);
    CHECK(answers.count() > 950);  // open: some share a slot
    if (kind != "open") CHECK(answers.count() == 1000);
    CHECK(stored == 1000);
    size_t wrong = 0;
    for (uint32_t i = 0; i < rays.size(); ++i) wrong += answers.found[i] && !(answers.hits[i] == hits[i]);
    CHECK(wrong == 0);
    for (CachedRay& ray : rays) ray.origin[2] = std::nextafter(ray.origin[2], 100.0f);
    CHECK(cache.find(rays).count() == 0);
  }
}

TEST_CASE("two rays that leave one wall in one direction share a result with a quantised key, not with an exact one") {
  const CachedRay first{{0, 0, 0}, {1, 0, 0}, 3, 7, 0}, second{{0, 5, 0}, {1, 0, 0}, 3, 7, 0};
  const Hit of_first{10, 100, 50}, of_second{4, 200, 60};
  for (const std::string kind : {"chained", "open", "concurrent"}) {
    CAPTURE(kind);
    for (const std::string key : {"quantised", "exact"}) {
      CAPTURE(key);
      CacheConfig config = config_of(kind, key);
      config.hit_point = "cached";
      config.hash_method = 1;
      Cache cache(config);
      cache.put(std::span(&first, 1), std::span(&of_first, 1));
      const Answers shared = cache.find(std::span(&second, 1));
      CHECK(shared.found[0] == (key == "quantised"));
      if (key == "quantised") {
        CHECK(shared.hits[0] == of_first);
        CHECK(shared.rays[0].origin == first.origin);  // hit_point = "cached": it goes on as the other ray
      } else if (kind != "open") {
        cache.put(std::span(&second, 1), std::span(&of_second, 1));
        CHECK(cache.find(std::span(&second, 1)).hits[0] == of_second);
        CHECK(cache.find(std::span(&first, 1)).hits[0] == of_first);
      }
    }
  }
}

TEST_CASE("rays that left a vehicle are neither answered nor stored with a quantised key, but with an exact one") {
  const uint32_t own = 0x80000000u | 2;  // WT_OWN: launched from a vehicle's antenna
  const std::vector<CachedRay> rays{
      {{0, 0, 0}, {1, 0, 0}, 5, 30, 0}, {{0, 0, 0}, {1, 0, 0}, 12, 70, 0}, {{0, 0, 0}, {1, 0, 0}, own, WT_NONE, 0}};
  const std::vector<Hit> hits{{1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  for (const std::string key : {"quantised", "exact"}) {
    CAPTURE(key);
    CacheConfig config = config_of("chained", key);
    config.hit_point = "cached";
    Cache cache(config);
    cache.static_surfaces = 10;
    const bool exact = key == "exact";
    cache.put(rays, hits);
    CHECK(cache.counters().stored == (exact ? 3 : 2));
    CHECK(cache.find(rays).found == std::vector{true, exact, true});
    cache.static_surfaces = WT_NONE;
    CHECK(cache.find(rays).found[1] == exact);
  }
}

TEST_CASE("precision: an entry answers while origin and direction are within the residual, by the L1 distance") {
  for (const std::string kind : {"chained", "open", "concurrent"}) {
    CAPTURE(kind);
    CacheConfig config = config_of(kind);
    config.purge = "precision";
    config.residual_value = 0.1;
    config.hit_point = "cached";
    Cache cache(config);
    const CachedRay ray{{1, 2, 3}, {0.6f, 0.8f, 0}, 3, 7, 0};
    const Hit hit{4, 5, 6};
    cache.put(std::span(&ray, 1), std::span(&hit, 1));
    cache.set_since(0, 9);  // is of no matter here
    cache.counters();
    std::vector<CachedRay> near(3, ray);
    near[0].origin = {1.03f, 1.97f, 3.03f};  // 0.09
    near[1].origin = {1.04f, 1.96f, 3.04f};  // 0.12, each component below 0.1
    near[2].origin = {1.09f, 2, 3};
    near[2].direction = {0.61f, 0.792f, 0};  // 0.108 together
    const Answers answers = cache.find(near);
    CHECK(answers.found == std::vector{true, false, false});
    CHECK(answers.hits[0] == hit);
    CHECK(cache.counters().stale == 2);
  }
}

TEST_CASE("scope all: a receiver must be within its radius of the cached segment, by the distance in space") {
  // Segments of 10 m along x, each with a receiver at its middle when it was stored.
  const std::vector<Float3> now{{5, 0, 0},   {5, 0.99f, 0}, {5, 5, 0},  {5, 0.9f, 0.9f}, {9.5f, 0, 0},
                                {12, 0, 0},  {-0.9f, 0, 0}, {5, 0, -3}, {-2, 0, 0},      {5, 0.7f, 0.7f}};
  const std::vector<bool> within{true, true, false, false, true, false, true, false, false, true};
  for (const std::string kind : {"chained", "open", "concurrent"}) {
    CAPTURE(kind);
    CacheConfig config = all_config(kind);
    config.buffer_size = 1 << 16;
    config.hash_method = 1;
    Cache cache(config);
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
    // Purged for good: also where the receiver comes back; and traced anew they take their place.
    for (size_t i = 0; i < now.size(); ++i) centres[4 * i + 1] = centres[4 * i + 2] = 0;
    cache.movement.receivers.write(centres);
    CHECK(cache.find(rays).found == within);
    cache.put(rays, hits);
    const wt_cache_counters counts = cache.counters();
    CHECK(counts.replaced == 5);
    CHECK(counts.duplicates == 5);
    CHECK(cache.find(rays).count() == rays.size());  // those five met no receiver
  }
  // The thesis keeps the third, whose x agrees, by algorithm 4, and the fourth, in the corner of the cube, by C.3.
  const thesis::Point point{5, 0, 0};
  CHECK(thesis::withinByAlgorithm4({5, 5, 0}, point, 1));
  CHECK(thesis::withinByListing({5, 0.9f, 0.9f}, point, 1));
}

TEST_CASE("scope all: what was left or met must not have moved since") {
  for (const std::string kind : {"chained", "open", "concurrent"}) {
    CAPTURE(kind);
    CacheConfig config = all_config(kind);
    config.buffer_size = 1 << 16;
    config.hash_method = 1;
    Cache cache(config);
    std::vector<wt_exact_surface> surfaces = of_the_environment(6);
    surfaces[2].instance = surfaces[3].instance = 0;
    surfaces[4].instance = surfaces[5].instance = 1;
    cache.scene.exact_surfaces = context().buffer(surfaces, "exact surfaces");
    const std::vector<CachedRay> rays{{{0, 0, 0}, {1, 0, 0}, 0, 1, 0},
                                      {{0, 0, 0}, {1, 0, 0}, 0, 2, 0},
                                      {{0, 0, 0}, {1, 0, 0}, 2, 3, 0},
                                      {{0, 0, 0}, {1, 0, 0}, 4, 4, 0},
                                      {{0, 0, 0}, {1, 0, 0}, 0, 5, 0},
                                      {{0, 0, 0}, {1, 0, 0}, 0x80000000u, WT_NONE, 0}};
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
  for (const std::string kind : {"open", "concurrent"}) {
    CAPTURE(kind);
    CacheConfig config = config_of(kind);
    config.hit_point = "cached";
    Cache cache(config, 2, 6, 12);
    const std::vector<CachedRay> rays = distinct(rays_in_room(5, 400, 2), config.division);
    const size_t half = rays.size() / 2;
    cache.put(rays, std::vector<Hit>(rays.size(), {1, 1, 1}));
    const size_t kept = cache.find(rays).count();
    cache.now = 4;
    cache.find(rays);  // untouched
    cache.touch = true;
    const size_t touched = cache.find(std::span(rays).first(half)).count();
    cache.touch = false;
    cache.counters();
    cache.purge(4);
    CHECK(cache.counters().evicted == kept - touched);
    const Answers answers = cache.find(rays);
    CHECK(answers.count() == touched);
    CHECK(touched > 0);
    for (size_t i = half; i < rays.size(); ++i) CHECK_FALSE(answers.found[i]);
    cache.put(rays, std::vector<Hit>(rays.size(), {2, 2, 2}));
    if (kind == "concurrent") CHECK(cache.find(rays).count() == rays.size());
  }
}

TEST_CASE("cache_store writes the hits of missed rays back into the whole queue") {
  Cache cache(config_of("chained"));
  const std::vector<CachedRay> rays = rays_in_room(6, 600, 1);
  std::vector<CachedRay> missed;
  std::vector<Hit> missed_hits, expected(rays.size(), {7, 7, 7});
  std::vector<uint32_t> indices;
  for (uint32_t i = 1; i < rays.size(); i += 3) {
    indices.push_back(i);
    missed.push_back(rays[i]);
    missed_hits.push_back(i % 2 ? Hit{static_cast<float>(i), i, i} : Hit{});
    expected[i] = missed_hits.back();
  }
  RayQueue queue = upload(rays);
  HitList all = upload_hits(std::vector<Hit>(rays.size(), {7, 7, 7}));
  CacheStore store(context(), cache.table);
  const auto missed_indices = context().buffer(indices, "indices");
  store(queue, upload(missed), upload_hits(missed_hits), missed_indices, all, cache.table, WT_NONE, 1);
  CHECK(download(all, rays.size()) == expected);
}
