// SPDX-License-Identifier: Apache-2.0
// The thesis' chained table (thesis_cache.hpp) and ours in the situations that it gets wrong.
// Faults of the listing are shown where they are certain to happen.
#include <doctest/doctest.h>

#include <array>
#include <unordered_map>
#include <vector>

#include "passes/cache_forest.hpp"
#include "passes/thesis_cache.hpp"

using namespace wavetracer;
using namespace wavetracer::device;
using namespace wavetracer::test;

TEST_CASE("keys of equal hash are told apart; the thesis takes one for the other") {
  // The pairs come from a birthday search in each hash: 32 bits, 300,000 keys, 10 pairs expected.
  Random random(31);
  std::unordered_map<uint32_t, CachedRay> ours, theirs[2];
  std::vector<std::array<CachedRay, 2>> our_pairs, their_pairs[2];
  const auto listing_key = [](const CachedRay& ray, int method) {
    return thesis::CacheKey(ray.surface, ray.left, ray.direction[0], ray.direction[1], ray.direction[2], method);
  };
  CacheConfig config = chained(64, 3, 1);
  Cache cache(config);
  for (int i = 0; i < 300000; ++i) {
    CachedRay ray = random_ray(random);
    ray.left = random.below(900);
    ray.surface = surface_of(ray.left);
    const uint64_t hash = wt_cache_hash1(cells_of(config, ray), ray.left, ray.surface);
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
  for (uint32_t depth = 0; depth < 3; ++depth) segments.push_back(random_rays(41 + depth, paths));
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
  // Look-ups along the path follow the links and are counted.
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
  CHECK(linked == 0);  // the fault: there should be 20 links
}
