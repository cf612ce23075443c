// SPDX-License-Identifier: Apache-2.0
// The chained table: many work-items at once; then the host checks the memory.
// It is small enough for Oclgrind; the same with many more operations is in large_cache_test.cpp.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "passes/cache_forest.hpp"

using namespace wavetracer;
using namespace wavetracer::device;
using namespace wavetracer::test;

TEST_CASE("chained cache: a key put by many work-items at once is in its tree once, whole, and found") {
  for (const uint32_t method : {1u, 2u, 3u})
    for (const CacheKey key : std::to_array<CacheKey>({"quantised", "exact"})) {
      CAPTURE(method);
      CAPTURE(key);
      CacheConfig config = chained(3 * 2048, 3, method);
      config.key = key;
      Cache cache(config, 3);
      // Copies lie in other work-groups, and each has its own hit.
      constexpr uint32_t keys = 384, copies = 8;
      const std::vector<CachedRay> once = random_rays(method, keys, 3);
      std::vector<CachedRay> rays;
      std::vector<Hit> hits;
      for (uint32_t copy = 0; copy < copies; ++copy)
        for (uint32_t k = 0; k < keys; ++k) {
          rays.push_back(once[k]);
          hits.push_back(hit_of(k, copy));
        }
      cache.put(rays, hits);
      const wt_cache_counters counts = cache.counters();
      CHECK(counts.stored == keys);
      CHECK(counts.stored + counts.duplicates + counts.dropped == rays.size());
      CHECK(counts.exhausted == 0);
      CHECK(counts.replaced == 0);
      const Forest forest(cache.table);
      check_whole(forest, keys);
      uint64_t used = 0;
      for (const uint32_t u : cache.table.used.read()) used += u;
      CHECK(used >= keys);  // work-items that came second took the others
      const Answers answers = cache.find(rays);
      CHECK(answers.count() == rays.size());
      size_t wrong = 0;
      for (uint32_t i = 0; i < rays.size(); ++i)
        wrong += answers.hits[i].surface != i % keys || answers.hits[i].primitive >= copies ||
                 answers.hits[i].t != hit_of(i % keys).t || !(answers.hits[i] == answers.hits[i % keys]);
      CHECK(wrong == 0);
      // The same operations again change nothing.
      cache.put(rays, hits);
      CHECK(cache.counters().duplicates == rays.size());
      CHECK(cache.find(rays).hits == answers.hits);
      CHECK(cache.find(random_rays(100 + method, 500, 3)).count() == 0);
    }
}

TEST_CASE("chained cache: both halves of a launch put the same keys, and whoever comes second sees the first") {
  // The half that starts later finds its keys stored, is faster, and catches up: from there on both meet at every key.
  // There are a few meetings in 10^5.
  const uint32_t keys = as_many(400000, 1000);
  Cache cache(chained(2 * keys));
  std::vector<CachedRay> rays = random_rays(15, keys);
  rays.insert(rays.end(), rays.begin(), rays.begin() + keys);
  cache.put(rays, hits_of(rays.size()));
  const wt_cache_counters counts = cache.counters();
  CHECK(counts.stored == keys);
  CHECK(counts.stored + counts.duplicates + counts.dropped == rays.size());
  check_whole(Forest(cache.table), keys);
  CHECK(cache.find(rays).count() == rays.size());
}

TEST_CASE("chained cache: regions hold keys for themselves") {
  Cache cache(chained(4096), 4);
  std::vector<CachedRay> rays = random_rays(11, 300);
  cache.put(rays, hits_of(300));
  for (CachedRay& ray : rays) ray.region = 2;
  CHECK(cache.find(rays).count() == 0);
  std::vector<Hit> others = hits_of(300);
  for (Hit& hit : others) hit.primitive = 7;
  cache.put(rays, others);
  CHECK(cache.find(rays).hits == others);
  for (CachedRay& ray : rays) ray.region = 0;
  CHECK(cache.find(rays).hits == hits_of(300));
  cache.table.clear(context(), 0);
  CHECK(cache.find(rays).count() == 0);
  for (CachedRay& ray : rays) ray.region = 2;
  CHECK(cache.find(rays).hits == others);
  check_whole(Forest(cache.table), 300);
}

TEST_CASE("chained cache: a pool that runs out drops what is new, counts it, and keeps what it has") {
  Cache cache(chained(512, 4), 2);
  const std::vector<CachedRay> rays = random_rays(21, 1024);  // four times the entries of region 0
  const std::vector<uint32_t> slots = cache.put(rays, hits_of(1024));
  wt_cache_counters counts = cache.counters();
  CHECK(counts.stored == 256);
  CHECK(counts.exhausted == 768);
  CHECK(counts.dropped == 768);
  check_whole(Forest(cache.table), 256);
  Answers answers = cache.find(rays);
  CHECK(answers.count() == 256);
  size_t wrong = 0;
  for (uint32_t i = 0; i < 1024; ++i) wrong += answers.found[i] && !(answers.hits[i] == hit_of(i));
  CHECK(wrong == 0);
  // The second time, stored keys are found, and the others still find no place.
  cache.put(rays, hits_of(1024));
  counts = cache.counters();
  CHECK(counts.duplicates == 256);
  CHECK(counts.exhausted == 768);
  CHECK(cache.find(rays).hits == answers.hits);
  CHECK(cache.table.used.read()[0] < 256 + 1024);  // asked for in vain, but it ends
  // The other region has room.
  std::vector<CachedRay> others = random_rays(22, 200);
  for (CachedRay& ray : others) ray.region = 1;
  cache.put(others, hits_of(200));
  CHECK(cache.find(others).hits == hits_of(200));
}

TEST_CASE("chained cache: trees stay flat when keys come in their own order into few buckets") {
  CacheConfig config = chained(2048, 64, 2);
  config.division = 200000;
  Cache cache(config);
  std::vector<CachedRay> rays;
  for (int i = 0; i < 2000; ++i) {
    const double turn = 1e-4 * i;
    rays.push_back({{0, 0, 0}, to_float({std::cos(turn), std::sin(turn), 0.1}), 3, 6, 0});
  }
  cache.put(rays, hits_of(rays.size()));
  const Forest forest(cache.table);
  check_whole(forest, rays.size());
  CHECK(forest.deepest > 8);    // a few buckets got all keys
  CHECK(forest.deepest <= 40);  // about 3 log2 of 2,000; in the order of the keys it would be hundreds
  CHECK(cache.find(rays).count() == rays.size());
}

TEST_CASE("chained cache: what does not stand is written anew in place") {
  Cache cache(chained(1024));
  const std::vector<CachedRay> rays = random_rays(51, 200);
  cache.put(rays, hits_of(200));
  cache.set_since(0, 5);  // the transmitter's position key changes (algorithm 3)
  cache.now = 5;
  cache.counters();
  CHECK(cache.find(rays).count() == 0);
  CHECK(cache.counters().stale == 200);
  std::vector<Hit> anew = hits_of(200);
  for (Hit& hit : anew) hit.primitive = 9;
  cache.put(rays, anew);
  const wt_cache_counters counts = cache.counters();
  CHECK(counts.stored == 200);
  CHECK(counts.replaced == 200);
  CHECK(counts.duplicates == 0);
  CHECK(cache.find(rays).hits == anew);
  CHECK(cache.table.used.read_one(0) == 200);
  check_whole(Forest(cache.table), 200);
}
