// SPDX-License-Identifier: Apache-2.0
// cache_lookup and cache_store on every kind of table: rays of a room against a model on the host, keys, and hits. If
// rays meet under a lock of the open table, one of them is refused. The device decides which one, and so which key is
// kept, but every wanted slot must get one of them.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "passes/cached_rays.hpp"

using namespace wavetracer;
using namespace wavetracer::device;
using namespace wavetracer::test;

namespace {

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

using Key = std::tuple<uint32_t, uint32_t, uint64_t>;
Key key_of(const CacheConfig& config, const CachedRay& ray) { return {ray.region, ray.left, cells_of(config, ray)}; }

// Keeps only the first ray of each key.
std::vector<CachedRay> distinct(const CacheConfig& config, const std::vector<CachedRay>& rays) {
  std::map<Key, CachedRay> first;
  for (const CachedRay& ray : rays) first.try_emplace(key_of(config, ray), ray);
  std::vector<CachedRay> out;
  for (const auto& [key, ray] : first) out.push_back(ray);
  return out;
}

// Puts rays of distinct keys into an empty table of this kind. Returns how many keys are in it.
size_t check_stored(Cache& cache, std::span<const CachedRay> rays) {
  const wt_cache_counters counts = cache.counters();
  CHECK(counts.stored + counts.dropped == rays.size());
  CHECK(counts.duplicates == 0);
  CHECK(counts.exhausted == 0);
  const size_t kept = counts.stored - counts.replaced;
  if (cache.table.config.kind == "open") {
    CHECK(kept == count_open_slots(cache.table, rays));
  } else {
    CHECK(kept == rays.size());
    CHECK(counts.replaced == 0);
  }
  size_t written = 0;
  for (const wt_cache_entry& entry : cache.table.entries.read()) written += entry.version != 0;
  CHECK(written == kept);
  return kept;
}

// The same rays ask: in the open table, those that share a slot may refuse each other.
void check_answered(Cache& cache, const Answers& answers, size_t kept) {
  const wt_cache_counters counts = cache.counters();
  CHECK(answers.count() <= kept);
  CHECK(answers.count() + counts.conflicts >= kept);
  if (cache.table.config.kind != "open") CHECK(counts.conflicts == 0);
}

}  // namespace

TEST_CASE("what was stored answers rays of its key, at their own points, and nothing else does") {
  // Half of a room: many rays leave it.
  std::vector<Corners> triangles = room(Room::box, 1, 5);
  triangles.resize(6);
  const Scene scene = scene_by_loader(triangles);
  const DeviceScene uploaded = make_device_scene(context(), scene, false);
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "open", "concurrent"})) {
    CAPTURE(kind);
    CacheConfig config = small_cache(kind);
    config.division = 8;
    Cache cache(config, 3, 6, 12);
    cache.scene.surfaces = uploaded.surfaces;
    const std::vector<CachedRay> rays = distinct(config, rays_in_room(1, 1500, 3));
    const std::vector<Hit> hits = traced(uploaded, rays);
    cache.put(rays, hits);
    const size_t kept = check_stored(cache, rays);
    CHECK(kept > 1200);
    std::map<Key, uint32_t> model;
    for (uint32_t i = 0; i < rays.size(); ++i) model[key_of(config, rays[i])] = i;
    check_answered(cache, cache.find(rays), kept);

    const std::vector<CachedRay> others = rays_in_room(2, 2000, 3);
    const Answers answers = cache.find(others);
    size_t wrong = 0, close_calls = 0, replaced = 0;
    for (uint32_t i = 0; i < others.size(); ++i) {
      const auto known = model.find(key_of(config, others[i]));
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
        wrong += kind != "open";  // another key may have the slot
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
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "open", "concurrent"})) {
    CAPTURE(kind);
    CacheConfig config = small_cache(kind, "exact");
    config.buffer_size = 1 << 16;
    Cache cache(config, 1, 6, 12);
    std::vector<CachedRay> rays = rays_in_room(3, 1000, 1);
    std::vector<Hit> hits;
    for (uint32_t i = 0; i < rays.size(); ++i) hits.push_back(i % 5 ? Hit{0.1f * static_cast<float>(i), i, i} : Hit{});
    cache.put(rays, hits);
    const size_t kept = check_stored(cache, rays);
    CHECK(kept > 950);
    const Answers answers = cache.find(rays);
    check_answered(cache, answers, kept);
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
  for (const CacheKind kind : std::to_array<CacheKind>({"chained", "open", "concurrent"})) {
    CAPTURE(kind);
    for (const CacheKey key : std::to_array<CacheKey>({"quantised", "exact"})) {
      CAPTURE(key);
      CacheConfig config = small_cache(kind, key);
      config.hit_point = "cached";
      config.hash_method = 1;
      Cache cache(config);
      cache.put(std::span(&first, 1), std::span(&of_first, 1));
      const Answers shared = cache.find(std::span(&second, 1));
      CHECK(shared.found[0] == (key == "quantised"));
      if (key == "quantised") {
        CHECK(shared.hits[0] == of_first);
        CHECK(shared.rays[0].origin == first.origin);  // hit_point = "cached": it continues as the other ray
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
  for (const CacheKey key : std::to_array<CacheKey>({"quantised", "exact"})) {
    CAPTURE(key);
    CacheConfig config = small_cache("chained", key);
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

TEST_CASE("cache_store writes the hits of missed rays back into the whole queue") {
  Cache cache(small_cache("chained"));
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
  store(cache.scene, queue, upload(missed), upload_hits(missed_hits), missed_indices, all, cache.table, WT_NONE, 1);
  CHECK(download(all, rays.size()) == expected);
}
