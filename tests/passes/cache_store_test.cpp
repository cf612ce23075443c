// SPDX-License-Identifier: Apache-2.0
// cache_store: the entries that it writes, word by word, where they may lie, and what it does to the whole queue. The
// expected entries are written by hand from the rays and their hits; cache_lookup is not asked.
#include "passes/cache_store.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "passes/cached_rays.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr auto every_kind = std::to_array<CacheKind>({"chained", "open", "concurrent"});

bool in_region(const CacheTable& table, uint32_t region, uint32_t slot) {
  const device::wt_cache_region& r = table.regions[region];
  return slot >= r.first_entry && slot < r.first_entry + r.entries;
}

// Tells whether an entry has what a ray that was traced in frame `now` leaves, all but its version.
bool holds(const device::wt_cache_entry& entry, const CacheConfig& config, const CachedRay& ray, const Hit& hit,
           uint32_t now, uint32_t receiver = WT_NONE) {
  return entry.cells == cells_of(config, ray) && entry.left == ray.left && entry.primitive == hit.primitive &&
         entry.surface == hit.surface && entry.t == (hit.missed() ? INFINITY : hit.t) && entry.time == now &&
         std::equal(ray.origin.begin(), ray.origin.end(), entry.origin) &&
         std::equal(ray.direction.begin(), ray.direction.end(), entry.direction) && entry.next == WT_NONE &&
         entry.receiver == receiver && entry.version % 2 == 0;
}

// Some rays, each of which left a primitive of its own, so that all have different keys.
std::vector<CachedRay> rays_of_many_primitives(uint32_t count, uint32_t regions) {
  std::vector<CachedRay> rays = random_rays(11, count, regions);
  for (uint32_t i = 0; i < count; ++i) rays[i].left = i, rays[i].surface = surface_of(i);
  return rays;
}

std::vector<Hit> hits_or_misses(uint32_t count) {
  std::vector<Hit> hits = hits_of(count);
  for (uint32_t i = 0; i < count; i += 5) hits[i] = {};
  return hits;
}

}  // namespace

TEST_CASE("cache_store: an entry has all words of its ray and hit, in the part of the table of its transmitter") {
  constexpr uint32_t count = 700, regions = 3, frame = 9;
  const std::vector<CachedRay> rays = rays_of_many_primitives(count, regions);
  const std::vector<Hit> hits = hits_or_misses(count);
  for (const CacheKind kind : every_kind) {
    CAPTURE(kind);
    Cache cache(small_cache(kind), regions);
    cache.now = frame;
    cache.put(rays, hits);
    size_t written = 0, wrong = 0;
    const auto entries = cache.table.entries.read();
    for (uint32_t slot = 0; slot < entries.size(); ++slot) {
      if (entries[slot].version == 0) continue;
      ++written;
      const uint32_t i = entries[slot].left;
      wrong += i >= count || !holds(entries[slot], cache.table.config, rays[i], hits[i], frame) ||
               !in_region(cache.table, rays[i].region, slot);
    }
    CHECK(wrong == 0);
    // An open table has one slot for a ray; rays of one slot overwrite each other.
    CHECK(written == (kind == "open" ? count_open_slots(cache.table, rays) : size_t{count}));
    const device::wt_cache_counters counts = cache.counters();
    CHECK(counts.stored + counts.dropped == count);
    CHECK(counts.stored - counts.replaced == written);
  }
}

TEST_CASE("cache_store: only rays of the list are stored, and their hits go into the whole queue alone") {
  constexpr uint32_t count = 600;
  for (const CacheKind kind : every_kind) {
    CAPTURE(kind);
    Cache cache(small_cache(kind));
    const std::vector<CachedRay> rays = rays_of_many_primitives(count, 1);
    std::vector<CachedRay> missed;
    std::vector<Hit> missed_hits, expected(count, {7, 7, 7});
    std::vector<uint32_t> indices;
    for (uint32_t i = 1; i < count; i += 3) {
      indices.push_back(i);
      missed.push_back(rays[i]);
      missed_hits.push_back(i % 2 ? Hit{static_cast<float>(i), i, i} : Hit{});
      expected[i] = missed_hits.back();
    }
    RayQueue queue = upload(rays);
    HitList all = upload_hits(std::vector<Hit>(count, {7, 7, 7}));
    CacheStore store(context(), cache.table);
    const auto missed_indices = context().buffer(indices, "indices");
    store(cache.scene, queue, upload(missed), upload_hits(missed_hits), missed_indices, all, cache.table, WT_NONE, 1);
    CHECK(download(all, count) == expected);
    for (const device::wt_cache_entry& entry : cache.table.entries.read())
      if (entry.version != 0) CHECK(entry.left % 3 == 1);
    RayQueue none = upload(std::vector<CachedRay>(1));
    none.count = 0;
    store(cache.scene, queue, none, upload_hits(missed_hits), missed_indices, all, cache.table, WT_NONE, 1);
    CHECK(download(all, count) == expected);
  }
}

TEST_CASE("cache_store: a ray that left what moves leaves its hit, but an entry only with an exact key") {
  constexpr uint32_t count = 200, static_surfaces = 60;
  const std::vector<CachedRay> rays = rays_of_many_primitives(count, 1);
  const std::vector<Hit> hits = hits_or_misses(count);
  for (const CacheKey key : std::to_array<CacheKey>({"quantised", "exact"})) {
    CAPTURE(key);
    Cache cache(small_cache("chained", key));
    cache.static_surfaces = static_surfaces;
    cache.put(rays, hits);
    size_t moving = 0, standing = 0;
    for (const device::wt_cache_entry& entry : cache.table.entries.read())
      if (entry.version != 0) ++(surface_of(entry.left) < static_surfaces ? standing : moving);
    CHECK(standing == 2 * static_surfaces);
    CHECK(moving == (key == "exact" ? count - 2 * static_surfaces : 0));
  }
}

TEST_CASE("cache_store: with scope all the first receiver is kept in the entry and in the whole queue") {
  constexpr uint32_t count = 150;
  CacheConfig config = small_cache("chained");
  config.scope = "all";
  Cache cache(config);
  const std::vector<CachedRay> rays = rays_of_many_primitives(count, 1);
  const std::vector<Hit> hits = hits_or_misses(count);
  std::vector<uint32_t> passed(count, WT_NONE), all(count);
  for (uint32_t i = 0; i < count; i += 2) passed[i] = 1000 + i;
  RayQueue queue = upload(rays);
  HitList list = make_hit_list(context(), count);
  // Missed ray k is ray count - 1 - k of the queue.
  for (uint32_t k = 0; k < count; ++k) all[k] = count - 1 - k;
  const auto indices = context().buffer(all, "indices"), receptions = context().buffer(passed, "receptions");
  auto receivers = context().buffer(std::vector<uint32_t>(count, 5u), "receivers");
  CacheStore store(context(), cache.table);
  store(cache.scene, queue, upload(rays), upload_hits(hits), indices, list, cache.table, WT_NONE, 1, &receptions,
        &receivers);
  CHECK(receivers.read() == std::vector<uint32_t>(passed.rbegin(), passed.rend()));
  size_t right = 0;
  for (const device::wt_cache_entry& entry : cache.table.entries.read()) {
    const uint32_t i = entry.left;
    right += entry.version != 0 && i < count && holds(entry, config, rays[i], hits[i], 1, passed[i]);
  }
  CHECK(right == count);
  CHECK_THROWS_AS(store(cache.scene, queue, upload(rays), upload_hits(hits), indices, list, cache.table, WT_NONE, 1),
                  std::invalid_argument);
}

TEST_CASE("cache_store: with statistics a ray learns its entry, and the entry before is linked to it") {
  constexpr uint32_t count = 100;
  CacheConfig config = small_cache("chained");
  config.statistics = true;
  Cache cache(config);
  std::vector<CachedRay> rays = rays_of_many_primitives(2 * count, 1);
  const std::vector<Hit> hits = hits_of(count);
  const std::vector<uint32_t> first = cache.put({rays.data(), count}, hits);
  for (uint32_t i = 0; i < count; ++i) rays[count + i].entry = first[i];
  const std::vector<uint32_t> second = cache.put({rays.data() + count, count}, hits);
  const auto entries = cache.table.entries.read();
  for (uint32_t i = 0; i < count; ++i) {
    REQUIRE(std::max(first[i], second[i]) < entries.size());
    CHECK(entries[first[i]].left == i);
    CHECK(entries[second[i]].left == count + i);
    CHECK(entries[first[i]].next == second[i]);
    CHECK(entries[second[i]].next == WT_NONE);
  }
  CHECK(cache.counters().linked == 0);
}
