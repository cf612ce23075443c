// The chained table: many work-items at once, and what is in memory afterwards, walked by the host; the thesis' table
// (thesis_cache.hpp) in the same situations.
#include <doctest/doctest.h>

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "passes/cache_forest.hpp"
#include "passes/cached_rays.hpp"
#include "passes/thesis_cache.hpp"
#include "passes/triangles.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::device;
using namespace wavetracer::test;

namespace {

CacheConfig chained(uint64_t entries, double load_factor = 3, uint32_t method = 3) {
  CacheConfig config;
  config.kind = "chained";
  config.buffer_size = entries;
  config.load_factor = load_factor;
  config.hash_method = method;
  config.hit_point = "cached";  // answers are what was put
  return config;
}

CachedRay ray_of(Random& random, uint32_t region = 0) {
  const uint32_t left = random.below(8) ? random.below(900) : WT_NONE;
  return {to_float(random.in_cube(50)), to_float(random.direction()), surface_of(left), left, region};
}

std::vector<CachedRay> rays_of(uint32_t seed, size_t count, uint32_t regions = 1) {
  Random random(seed);
  std::vector<CachedRay> rays;
  for (size_t i = 0; i < count; ++i) rays.push_back(ray_of(random, static_cast<uint32_t>(i) % regions));
  return rays;
}

uint64_t cells_of(const CacheTable& table, const CachedRay& ray) {
  const uint32_t division = table.config.key == "exact" ? WT_CACHE_MAX_DIVISION : table.config.division;
  return wt_cache_cells(ray.direction[0], ray.direction[1], ray.direction[2], division);
}

// A hit that says whose it is.
Hit hit_of(uint32_t key, uint32_t copy = 0) { return {1.0f + static_cast<float>(key), copy, key}; }

std::vector<Hit> hits_of(size_t count) {
  std::vector<Hit> hits;
  for (uint32_t i = 0; i < count; ++i) hits.push_back(hit_of(i));
  return hits;
}

void check_whole(const Forest& forest, size_t nodes) {
  CHECK(forest.nodes == nodes);
  CHECK(forest.wrong_bucket == 0);
  CHECK(forest.out_of_order == 0);
}

}  // namespace

TEST_CASE("chained cache: a key put by many work-items at once is in its tree once, whole, and found") {
  for (const uint32_t method : {1u, 2u, 3u})
    for (const char* key : {"quantised", "exact"}) {
      CAPTURE(method);
      CAPTURE(key);
      CacheConfig config = chained(3 * 2048, 3, method);
      config.key = key;
      Cache cache(config, 3);
      // Copies lie in other work-groups, and each has a hit of its own.
      constexpr uint32_t keys = 384, copies = 8;
      const std::vector<CachedRay> once = rays_of(method, keys, 3);
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
      CHECK(used >= keys);  // the others were taken by work-items that came second
      const Answers answers = cache.find(rays);
      CHECK(answers.count() == rays.size());
      size_t wrong = 0;
      for (uint32_t i = 0; i < rays.size(); ++i)
        wrong += answers.hits[i].surface != i % keys || answers.hits[i].primitive >= copies ||
                 answers.hits[i].t != hit_of(i % keys).t || !(answers.hits[i] == answers.hits[i % keys]);
      CHECK(wrong == 0);
      // The same again: nothing changes.
      cache.put(rays, hits);
      CHECK(cache.counters().duplicates == rays.size());
      CHECK(cache.find(rays).hits == answers.hits);
      CHECK(cache.find(rays_of(100 + method, 500, 3)).count() == 0);
    }
}

TEST_CASE("chained cache: both halves of a launch put the same keys, and whoever comes second sees the first") {
  // The half that starts late finds its keys put, is faster, and catches up: from there on the two meet at every key.
  // A few meetings in 10^5: few keys only for Oclgrind, which runs one work-item at a time.
  const uint32_t keys = context().info().platform == "Oclgrind" ? 1000 : 400000;
  Cache cache(chained(2 * keys));
  std::vector<CachedRay> rays = rays_of(15, keys);
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
  std::vector<CachedRay> rays = rays_of(11, 300);
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
  const std::vector<CachedRay> rays = rays_of(21, 1024);  // four times the entries of region 0
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
  // Again: what is there is there, what is not finds no place.
  cache.put(rays, hits_of(1024));
  counts = cache.counters();
  CHECK(counts.duplicates == 256);
  CHECK(counts.exhausted == 768);
  CHECK(cache.find(rays).hits == answers.hits);
  CHECK(cache.table.used.read()[0] < 256 + 1024);  // asked for in vain, but not for ever
  // The other region has room.
  std::vector<CachedRay> others = rays_of(22, 200);
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
  CHECK(forest.deepest > 8);    // a few buckets took all
  CHECK(forest.deepest <= 40);  // about 3 log2 of 2,000; in the order of the keys it would be hundreds
  CHECK(cache.find(rays).count() == rays.size());
}

TEST_CASE("keys of equal hash are told apart; the thesis takes one for the other") {
  // By a birthday search in each hash: 32 bits, 300,000 keys, 10 pairs expected.
  Random random(31);
  std::unordered_map<uint32_t, CachedRay> ours, theirs[2];
  std::vector<std::array<CachedRay, 2>> our_pairs, their_pairs[2];
  const auto listing_key = [](const CachedRay& ray, int method) {
    return thesis::CacheKey(ray.surface, ray.left, ray.direction[0], ray.direction[1], ray.direction[2], method);
  };
  CacheConfig config = chained(64, 3, 1);
  Cache cache(config);
  for (int i = 0; i < 300000; ++i) {
    CachedRay ray = ray_of(random);
    ray.left = random.below(900);
    ray.surface = surface_of(ray.left);
    const uint64_t hash = wt_cache_hash1(cells_of(cache.table, ray), ray.left, ray.surface);
    const auto [same, fresh] = ours.try_emplace(static_cast<uint32_t>(hash >> 32), ray);
    if (!fresh) our_pairs.push_back({same->second, ray});
    for (const int m : {0, 1}) {
      const auto [other, is_new] = theirs[m].try_emplace(listing_key(ray, m == 0 ? 1 : 3).hash, ray);
      if (!is_new) their_pairs[m].push_back({other->second, ray});
    }
  }
  for (const int m : {0, 1}) {
    REQUIRE(!their_pairs[m].empty());
    const thesis::CacheKey a = listing_key(their_pairs[m][0][0], m == 0 ? 1 : 3);
    const thesis::CacheKey b = listing_key(their_pairs[m][0][1], m == 0 ? 1 : 3);
    CHECK_FALSE(a == b);
    thesis::ChainedTable table(100, 4);
    int previous = -1;
    table.writeToCache(a, 17, previous);
    REQUIRE(table.getFromCache(b).has_value());
    CHECK(*table.getFromCache(b) == 17);  // the fault
    our_pairs.push_back(their_pairs[m][0]);
  }
  REQUIRE(our_pairs.size() > 2);
  for (const std::array<CachedRay, 2>& pair : our_pairs) {
    cache.table.clear(context());
    cache.put(std::span(pair).first(1), hits_of(1));
    CHECK(cache.find(std::span(pair).first(1)).count() == 1);
    CHECK(cache.find(std::span(pair).last(1)).count() == 0);
    cache.put(pair, hits_of(2));
    CHECK(cache.find(pair).hits == hits_of(2));
  }
}

TEST_CASE("entries of a path are linked below the root as well; the thesis returns before it links") {
  CacheConfig config = chained(64, 64);  // one bucket, one tree
  config.statistics = true;
  Cache cache(config);
  constexpr uint32_t paths = 10;
  std::vector<std::vector<CachedRay>> segments;
  for (uint32_t depth = 0; depth < 3; ++depth) segments.push_back(rays_of(41 + depth, paths));
  std::vector<std::vector<uint32_t>> slots;
  for (uint32_t depth = 0; depth < 3; ++depth) {
    if (depth > 0)
      for (uint32_t i = 0; i < paths; ++i) segments[depth][i].entry = slots[depth - 1][i];
    slots.push_back(cache.put(segments[depth], hits_of(paths)));
  }
  const std::vector<wt_cache_entry> entries = cache.table.entries.read();
  size_t unlinked = 0;
  for (uint32_t i = 0; i < paths; ++i) {
    unlinked += entries[slots[0][i]].next != slots[1][i] || entries[slots[1][i]].next != slots[2][i];
    CHECK(entries[slots[2][i]].next == WT_NONE);
  }
  CHECK(unlinked == 0);
  CHECK(Forest(cache.table).nodes == 3 * paths);
  // Look-ups along the path follow the links, and count.
  cache.counters();
  std::vector<uint32_t> before(paths, WT_NONE);
  for (uint32_t depth = 0; depth < 3; ++depth) {
    for (uint32_t i = 0; i < paths; ++i) segments[depth][i].entry = before[i];
    const Answers answers = cache.find(segments[depth]);
    CHECK(answers.count() == paths);
    before = answers.entries;
    CHECK(before == slots[depth]);
  }
  CHECK(cache.counters().linked == 2 * paths);
  for (const std::vector<uint32_t>& of_depth : slots)
    for (const uint32_t slot : of_depth) CHECK(cache.table.hits.read_one(slot) == 1);

  thesis::ChainedTable table(2, 64);  // one bucket of two is ever used
  size_t linked = 0;
  for (uint32_t i = 0; i < paths; ++i) {
    int previous = -1;
    for (uint32_t depth = 0; depth < 3; ++depth) {
      const CachedRay& ray = segments[depth][i];
      const Float3& d = ray.direction;
      table.writeToCache(thesis::CacheKey(ray.surface, ray.left, d[0], d[1], d[2], 1), i, previous);
    }
  }
  for (const thesis::ChainedTable::Node& node : table.nodes) linked += node.queue != -1;
  CHECK(linked == 0);  // the fault: 20 links are wanted
}

TEST_CASE("chained cache: what does not stand is written anew in place") {
  Cache cache(chained(1024));
  const std::vector<CachedRay> rays = rays_of(51, 200);
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

TEST_CASE("cache_purge clears a chained region when more than half of it is old") {
  Cache cache(chained(2048), 2);
  const std::vector<CachedRay> early = rays_of(61, 300, 2), late = rays_of(62, 100, 2);
  cache.put(early, hits_of(300));
  cache.now = 2;
  cache.put(late, hits_of(100));
  cache.touch = true;
  std::vector<CachedRay> touched;  // of region 0, 100 of 150
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

TEST_CASE("sizes of tables: shares, buckets, and errors that name limit and value") {
  const auto message = [](const CacheConfig& config, uint32_t transmitters) {
    try {
      make_cache_table(context(), config, transmitters, 10, 10);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const CacheTable table = make_cache_table(context(), chained(1000, 3), 3, 10, 10);
  CHECK(table.regions.size() == 3);
  CHECK(table.regions[2].entries == 333);
  CHECK(table.regions[2].first_entry == 666);
  CHECK(table.regions[2].buckets == 111);
  CHECK(table.regions[2].first_bucket == 222);
  CHECK(table.entries.size() == 999);
  CHECK(table.heads.size() == 333 + 2 * 999);
  CHECK(table.bytes() == 999 * 64 + 4 * (333 + 2 * 999) + 3 * 4 + 3 * sizeof(wt_cache_region) +
                             sizeof(wt_cache_counters) + 4);
  CHECK(make_cache_table(context(), chained(16, 64), 1, 10, 10).regions[0].buckets == 1);
  CacheConfig config = chained(1000);
  config.kind = "concurrent";
  CHECK(make_cache_table(context(), config, 3, 10, 10).regions[1].entries == 328);  // buckets are whole
  config.kind = "open";
  CHECK(make_cache_table(context(), config, 3, 10, 10).heads.size() == 2 * 999);

  const std::string small = message(chained(100), 20);
  CHECK(small.find("cache.buffer_size = 100 is too small: 20 transmitters") != std::string::npos);
  CHECK(small.find("give 320 or more") != std::string::npos);
  CHECK(message(chained(320), 20).empty());
  const std::string huge = message(chained(uint64_t{1} << 32), 1);
  CHECK(huge.find("cache.buffer_size = 4294967296 is too large: a table has 2147483648 entries at most") !=
        std::string::npos);
  const uint64_t fitting = context().info().max_buffer / sizeof(wt_cache_entry);
  if (fitting + 1 <= uint64_t{1} << 31) {
    const std::string large = message(chained(fitting + 1), 1);
    CHECK(large.find("cache.buffer_size = " + std::to_string(fitting + 1)) != std::string::npos);
    CHECK(large.find(std::to_string((fitting + 1) * sizeof(wt_cache_entry))) != std::string::npos);
    CHECK(large.find(std::to_string(context().info().max_buffer)) != std::string::npos);
  }
}
