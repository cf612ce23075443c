// SPDX-License-Identifier: Apache-2.0
// The thesis' tables on the device (cache.kind = "thesis", "thesis-chained") against its listings on the host, one
// operation at a time: they give the same answers, refusals and errors. Then come the faults that distinguish them from
// ours.
#include <doctest/doctest.h>

#include <unordered_map>

#include "passes/cached_rays.hpp"
#include "passes/thesis_cache.hpp"
#include "wavetracer/device/cache_thesis.h"
#include "wavetracer/device/moving.h"

using namespace wavetracer;
using namespace wavetracer::device;
using namespace wavetracer::test;

namespace {

CacheConfig printed(CacheKind kind, uint32_t entries, uint32_t hash_method) {
  CacheConfig config = small_cache(kind);
  config.buffer_size = entries;
  config.hash_method = hash_method;
  config.division = 16;
  config.readers_number = 3;
  config.load_factor = 3;
  config.scope = "all";
  config.hit_point = "cached";
  return config;
}

// Surfaces from this number on are those of vehicles, a hundred each; those before are the environment.
constexpr uint32_t static_surfaces = 300, surfaces_a_vehicle = 100;

// Section 3.2.3: an environment is loaded as one model, "which usually has -1 as id"; a vehicle has the id of its
// model; a ray from the buffer has 0.
uint16_t model_id(uint32_t surface) {
  if (surface == WT_NONE) return 0;
  if (surface < static_surfaces) return static_cast<uint16_t>(-1);
  return static_cast<uint16_t>(1 + (surface - static_surfaces) / surfaces_a_vehicle);
}

// Gives the world of a cache the vehicles of model_id().
void add_vehicles(Cache& cache) {
  std::vector<wt_exact_surface> surfaces(1000);
  for (uint32_t i = 0; i < surfaces.size(); ++i)
    surfaces[i].instance = i < static_surfaces ? WT_NONE : (i - static_surfaces) / surfaces_a_vehicle;
  cache.scene.exact_surfaces = context().buffer(surfaces, "exact surfaces");
  cache.movement.instance_since = context().buffer(std::vector<uint32_t>(10), "instances moved");
}

thesis::CacheKey listing_key(const CacheConfig& config, const CachedRay& ray) {
  return {model_id(ray.left == WT_NONE ? WT_NONE : ray.surface),
          ray.left == WT_NONE ? 0 : ray.left,
          ray.direction[0],
          ray.direction[1],
          ray.direction[2],
          static_cast<int>(config.hash_method),
          static_cast<int>(config.division)};
}

// There are few keys, each used again and again, so that operations meet.
std::vector<CachedRay> few_rays(uint32_t seed, size_t count) {
  Random random(seed);
  const std::vector<CachedRay> keys = random_rays(seed, 30);
  std::vector<CachedRay> rays;
  for (size_t i = 0; i < count; ++i) {
    rays.push_back(keys[random.below(30)]);
    if (rays.back().left == WT_NONE) rays.back().surface = WT_OWN | 2;  // the vehicle that carries the transmitter
  }
  return rays;
}

// The hit is near the start of the ray, so that some answer by precision.
Hit near_hit(uint32_t i) { return {0.1f * static_cast<float>(i % 7), 0, i}; }

thesis::Point point(const Float3& p) { return {p[0], p[1], p[2]}; }

thesis::Point hit_point(const CachedRay& ray, const Hit& hit) {
  return {ray.origin[0] + hit.t * ray.direction[0], ray.origin[1] + hit.t * ray.direction[1],
          ray.origin[2] + hit.t * ray.direction[2]};
}

}  // namespace

TEST_CASE("printed tables: hashes and buckets are those of the listings") {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    CachedRay ray = random_ray(random);
    ray.left = random.below(2) ? random.below(0x7FFFFFFF) : random.below(1000);
    ray.surface = random.below(1000);
    const uint32_t instance =
        ray.surface < static_surfaces ? WT_NONE : (ray.surface - static_surfaces) / surfaces_a_vehicle;
    for (const uint32_t method : {1u, 2u, 3u}) {
      CacheConfig config = printed("thesis", 64, method);
      config.division = 200000;
      const uint32_t hash = listing_key(config, ray).hash;
      CHECK(wt_thesis_hash(method, cells_of(config, ray), ray.left, wt_thesis_model(instance)) == hash);
      for (const uint32_t size : {64u, 50000u, 300000u}) {
        CHECK(wt_thesis_slot(hash, size) == thesis::getBucketIndex(hash, static_cast<int>(size)));
        CHECK(wt_thesis_slot(hash, size) <= size / 2);  // the fault
        CHECK(wt_thesis_bucket(hash, size) == thesis::getSignedBucketIndex(hash, static_cast<int>(size)));
      }
    }
  }
  CHECK(wt_thesis_bucket(0x7FFFFFFF, 0xFFFFFFF0u) < 0xFFFFFFF0u);  // float rounds up here
}

TEST_CASE("thesis: the open table answers as listing C.3, by position and by precision") {
  for (const CachePurging purge : std::to_array<CachePurging>({"position", "precision"})) {
    CAPTURE(purge);
    CacheConfig config = printed("thesis", 16, 3);
    config.purge = purge;
    config.residual_value = 60;
    Cache cache(config);
    add_vehicles(cache);
    cache.set_stamp(0, 7);
    thesis::OpenTable listing(16, config.readers_number, static_cast<float>(config.residual_value));
    const std::vector<CachedRay> rays = few_rays(3, 400);
    Random random(4);
    size_t answered = 0, others = 0, refused = 0;
    uint32_t stamp = 7;
    for (uint32_t i = 0; i < rays.size(); ++i) {
      if (random.below(20) == 0) cache.set_stamp(0, stamp = 5 + random.below(4));
      const std::span<const CachedRay> ray(&rays[i], 1);
      const thesis::CacheKey key = listing_key(config, rays[i]);
      if (random.below(3) == 0) {
        const Hit hit = near_hit(i);
        const bool written = listing.writeToCache(key, hit.surface, hit_point(rays[i], hit), stamp);
        cache.put(ray, {&hit, 1});
        CHECK(cache.counters().stored == written);
        refused += !written;
        continue;
      }
      const auto expected =
          purge == "position" ? listing.getFromCache(key, stamp) : listing.getFromCacheRes(key, point(rays[i].origin));
      const Answers found = cache.find(ray);
      CHECK(found.found[0] == expected.has_value());
      if (!expected || !found.found[0]) continue;
      CHECK(found.hits[0].surface == *expected);
      CHECK(found.rays[0].origin == rays[*expected].origin);
      ++answered;
      others += !(listing_key(config, rays[*expected]) == key);
    }
    CHECK(answered > 20);
    CHECK(refused > 20);  // slots whose write lock is never opened
    CHECK(others > 5);    // the fault: answers of other keys
  }
}

TEST_CASE("thesis-chained: the chained table answers as listing C.2") {
  for (const uint32_t method : {1u, 2u, 3u}) {
    CAPTURE(method);
    const CacheConfig config = printed("thesis-chained", 60, method);
    Cache cache(config);
    add_vehicles(cache);
    thesis::ChainedTable listing(20, 3);
    const std::vector<CachedRay> rays = few_rays(5, 300);
    Random random(6);
    size_t answered = 0;
    for (uint32_t i = 0; i < rays.size(); ++i) {
      const std::span<const CachedRay> ray(&rays[i], 1);
      const thesis::CacheKey key = listing_key(config, rays[i]);
      if (random.below(3) == 0) {
        int previous = -1;
        const Hit hit = near_hit(i);
        listing.writeToCache(key, hit.surface, previous);
        cache.put(ray, {&hit, 1});
        continue;
      }
      const auto expected = listing.getFromCache(key);
      const Answers found = cache.find(ray);
      CHECK(found.found[0] == expected.has_value());
      if (!expected || !found.found[0]) continue;
      CHECK(found.hits[0].surface == *expected);
      ++answered;
    }
    CHECK(answered > 5);
    const auto used = static_cast<size_t>(
        std::count_if(listing.nodes.begin(), listing.nodes.end(), [](const auto& node) { return node.used; }));
    CHECK(cache.table.used.read_one(0) == used);
  }
}

TEST_CASE("thesis-chained: equal hashes answer for each other, and a key that came often fills its bucket; ours not") {
  Random random(31);
  CacheConfig config = printed("thesis-chained", 30000, 1);
  config.division = 200000;
  CacheConfig ours = config;
  ours.kind = "chained";
  std::unordered_map<uint32_t, CachedRay> seen;
  std::vector<CachedRay> pair;
  while (pair.empty()) {  // by a birthday search: 32 bits, some 80,000 keys
    CachedRay ray = random_ray(random);
    ray.left = random.below(900);
    ray.surface = surface_of(ray.left);
    const auto [same, fresh] = seen.try_emplace(listing_key(config, ray).hash, ray);
    if (!fresh) pair = {same->second, ray};
  }
  for (const CacheConfig& kind : {config, ours}) {
    CAPTURE(kind.kind);
    Cache cache(kind);
    add_vehicles(cache);
    cache.put(std::span(pair).first(1), hits_of(1));
    const Answers other = cache.find(std::span(pair).last(1));
    CHECK(other.found[0] == (kind.kind == "thesis-chained"));
    if (other.found[0]) CHECK(other.hits[0] == hit_of(0));
    for (int again = 0; again < 5; ++again) cache.put(std::span(pair).first(1), hits_of(1));
    CHECK(cache.counters().exhausted == (kind.kind == "thesis-chained" ? 3u : 0u));  // three of six had room
  }
}

TEST_CASE("thesis: the environment is one model, whatever the surface; a vehicle is another") {
  CacheConfig config = printed("thesis", 3000, 2);
  config.locking = "mutex";
  const CachedRay wall = {{}, {1, 0, 0}, 10, 77}, other_wall = {{}, {1, 0, 0}, 211, 77},
                  vehicle = {{}, {1, 0, 0}, static_surfaces, 77};
  Cache cache(config);
  add_vehicles(cache);
  cache.put({&wall, 1}, hits_of(1));
  CHECK(cache.find({&other_wall, 1}).found[0]);
  CHECK(!cache.find({&vehicle, 1}).found[0]);
}

TEST_CASE("thesis: with a mutex nothing dies, and keys are still not compared") {
  CacheConfig config = printed("thesis", 16, 1);
  config.locking = "mutex";
  Cache cache(config);
  add_vehicles(cache);
  const std::vector<CachedRay> rays = few_rays(8, 64);
  for (size_t i = 0; i < rays.size(); ++i) {
    const Hit hit = hit_of(static_cast<uint32_t>(i));
    cache.put(std::span(rays).subspan(i, 1), {&hit, 1});
  }
  CHECK(cache.counters().dropped == 0);
  const std::vector<bool> found = cache.find_one_by_one(rays), again = cache.find_one_by_one(rays);
  CHECK(std::count(found.begin(), found.end(), false) == 0);  // each slot that they may use is written
  CHECK(found == again);
}
