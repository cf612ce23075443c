// SPDX-License-Identifier: Apache-2.0
// A ray cache on the device for tests: labelled rays as plain records, put into it and looked up by its own passes.
// Stored hits are given, not traced: any hit for any ray.
#pragma once
#include <numeric>
#include <set>
#include <span>

#include "passes/cache_lookup.hpp"
#include "passes/cache_purge.hpp"
#include "passes/cache_store.hpp"
#include "passes/triangles.hpp"

namespace wavetracer::test {

// A small table, in which no entry wears out.
inline CacheConfig small_cache(CacheKind kind, CacheKey key = "quantised") {
  CacheConfig config;
  config.kind = kind;
  config.key = key;
  config.buffer_size = 3 * 4096;
  config.division = 16;
  config.readers_number = 1000;
  return config;
}

struct CachedRay {
  Float3 origin{}, direction{1, 0, 0};
  uint32_t surface = WT_NONE, left = WT_NONE, region = 0, entry = WT_NONE;
};

// Random rays of many primitives, two per surface, and some of the transmitter.
inline uint32_t surface_of(uint32_t left) { return left == WT_NONE ? WT_NONE : left / 2; }

inline CachedRay random_ray(Random& random, uint32_t region = 0) {
  const uint32_t left = random.below(8) ? random.below(900) : WT_NONE;
  return {to_float(random.in_cube(50)), to_float(random.direction()), surface_of(left), left, region};
}

inline std::vector<CachedRay> random_rays(uint32_t seed, size_t count, uint32_t regions = 1) {
  Random random(seed);
  std::vector<CachedRay> rays;
  for (size_t i = 0; i < count; ++i) rays.push_back(random_ray(random, static_cast<uint32_t>(i) % regions));
  return rays;
}

// Hits identify their ray.
inline Hit hit_of(uint32_t key, uint32_t copy = 0) { return {1.0f + static_cast<float>(key), copy, key}; }

inline std::vector<Hit> hits_of(size_t count) {
  std::vector<Hit> hits;
  for (uint32_t i = 0; i < count; ++i) hits.push_back(hit_of(i));
  return hits;
}

inline uint64_t cells_of(const CacheConfig& config, const CachedRay& ray) {
  const uint32_t division = config.exact() ? WT_CACHE_MAX_DIVISION : config.division;
  return device::wt_cache_cells(ray.direction[0], ray.direction[1], ray.direction[2], division);
}

// Returns the only slot of an open table that a ray may lie in.
inline uint32_t open_slot(const CacheTable& table, const CachedRay& ray) {
  const device::wt_cache_region& region = table.regions[ray.region];
  const uint64_t hash =
      device::wt_cache_hash(table.config.hash_method, cells_of(table.config, ray), ray.left, ray.surface, table.widths);
  return region.first_entry + device::wt_cache_bucket(hash, region.entries);
}

inline size_t count_open_slots(const CacheTable& table, std::span<const CachedRay> rays) {
  std::set<uint32_t> slots;
  for (const CachedRay& ray : rays) slots.insert(open_slot(table, ray));
  return slots.size();
}

inline RayQueue upload(std::span<const CachedRay> rays) {
  RayQueue queue = make_ray_queue(context(), rays.size(), "test rays", WT_RAY_LABELLED_PLANES);
  queue.count = static_cast<uint32_t>(rays.size());
  std::vector<float> planes(queue.planes.size());
  for (size_t i = 0; i < rays.size(); ++i) {
    const auto word = [&](size_t plane, uint32_t value) {
      planes[plane * queue.capacity + i] = std::bit_cast<float>(value);
    };
    for (size_t axis = 0; axis < 3; ++axis) {
      planes[(WT_RAY_ORIGIN + axis) * queue.capacity + i] = rays[i].origin[axis];
      planes[(WT_RAY_DIRECTION + axis) * queue.capacity + i] = rays[i].direction[axis];
    }
    word(WT_RAY_SURFACE, rays[i].surface);
    word(WT_RAY_LEFT, rays[i].left);
    word(WT_RAY_REGION, rays[i].region);
    word(WT_RAY_ENTRY, rays[i].entry);
  }
  queue.planes.write(planes);
  return queue;
}

inline HitList upload_hits(std::span<const Hit> hits) {
  HitList list = make_hit_list(context(), hits.size());
  std::vector<float> planes(list.planes.size());
  for (size_t i = 0; i < hits.size(); ++i) {
    planes[i] = hits[i].t;
    planes[size_t{WT_HIT_PRIMITIVE} * list.capacity + i] = std::bit_cast<float>(hits[i].primitive);
    planes[size_t{WT_HIT_SURFACE} * list.capacity + i] = std::bit_cast<float>(hits[i].surface);
  }
  list.planes.write(planes);
  return list;
}

inline std::vector<uint32_t> entries_of(const RayQueue& queue) {
  std::vector<uint32_t> entries(queue.count);
  const std::vector<float> planes = queue.planes.read(size_t{WT_RAY_ENTRY} * queue.capacity, queue.count);
  std::transform(planes.begin(), planes.end(), entries.begin(), [](float x) { return std::bit_cast<uint32_t>(x); });
  return entries;
}

struct Answers {
  std::vector<bool> found;
  std::vector<Hit> hits;  // default if not found
  std::vector<Ray> rays;  // rays after the operation
  std::vector<uint32_t> entries, receptions;
  size_t count() const { return static_cast<size_t>(std::count(found.begin(), found.end(), true)); }
};

class Cache {
 public:
  CacheTable table;
  CacheMovement movement = make_cache_movement(context());
  DeviceScene scene;  // surfaces only
  uint32_t static_surfaces = WT_NONE, now = 1;
  bool touch = false;

  explicit Cache(const CacheConfig& config, uint32_t regions = 1, uint32_t surfaces = 1000, uint32_t primitives = 1000)
      : table(make_cache_table(context(), config, regions, surfaces, primitives)),
        lookup_(context(), table),
        store_(context(), table),
        purge_(context(), table) {
    scene.surfaces = context().buffer<wt_surface>(1, "surfaces");
    scene.exact_surfaces = context().buffer<wt_exact_surface>(1, "exact surfaces");
  }

  // Returns the resulting plane WT_RAY_ENTRY; hits and receptions: one per ray.
  std::vector<uint32_t> put(std::span<const CachedRay> rays, std::span<const Hit> hits,
                            std::vector<uint32_t> receptions = {}) {
    RayQueue queue = upload(rays);
    const RayQueue missed = upload(rays);
    const HitList list = upload_hits(hits);
    HitList all = make_hit_list(context(), rays.size());
    std::vector<uint32_t> every(rays.size());
    std::iota(every.begin(), every.end(), 0u);
    receptions.resize(rays.size(), WT_NONE);
    const auto received = context().buffer(receptions, "receptions");
    auto receivers = context().buffer<uint32_t>(rays.size(), "receivers");
    store_(scene, queue, missed, list, context().buffer(every, "indices"), all, table, static_surfaces, now, &received,
           &receivers);
    return entries_of(queue);
  }

  Answers find(std::span<const CachedRay> rays) {
    RayQueue queue = upload(rays);
    HitList list = upload_hits(std::vector<Hit>(rays.size()));
    auto missed = context().buffer<float>(queue.capacity, "missed");
    auto receptions = context().buffer(std::vector<uint32_t>(rays.size(), 12345u), "receptions");
    lookup_(scene, queue, list, missed, table, movement, static_surfaces, now, touch, &receptions);
    Answers out{{}, download(list, rays.size()), download(queue), entries_of(queue), receptions.read()};
    const std::vector<float> marks = missed.read();
    for (uint32_t i = 0; i < rays.size(); ++i) {
      const auto mark = std::bit_cast<uint32_t>(marks[i]);
      if (mark != WT_NONE && mark != i) throw std::logic_error("missed[i] is neither i nor WT_NONE");
      out.found.push_back(mark == WT_NONE);
    }
    return out;
  }

  // Each ray has its own launch, so that none meets another under a lock.
  std::vector<bool> find_one_by_one(std::span<const CachedRay> rays) {
    std::vector<bool> found;
    for (size_t i = 0; i < rays.size(); ++i) found.push_back(find(rays.subspan(i, 1)).found[0]);
    return found;
  }

  void purge(uint32_t keep_from) { purge_(context(), table, keep_from); }
  // Returns the counts since the last call.
  device::wt_cache_counters counters() {
    const device::wt_cache_counters counts = table.counters.read_one(0);
    table.counters.write(std::vector<device::wt_cache_counters>(1));
    return counts;
  }
  // Sets the transmitter's position key.
  void set_stamp(uint32_t region, uint32_t stamp) {
    table.regions[region].stamp = stamp;
    table.device_regions.write(table.regions);
  }
  void set_since(uint32_t region, uint32_t frame) {
    table.regions[region].since = frame;
    table.device_regions.write(table.regions);
  }

 private:
  CacheLookup lookup_;
  CacheStore store_;
  CachePurge purge_;
};

}  // namespace wavetracer::test
