// A ray cache on the device for tests: labelled rays as plain records, put into it and looked up by its own passes.
// What is put is given, not traced: any hit for any ray.
#pragma once
#include <numeric>
#include <span>

#include "passes/cache_lookup.hpp"
#include "passes/cache_purge.hpp"
#include "passes/cache_store.hpp"
#include "passes/on_device.hpp"

namespace wavetracer::test {

struct CachedRay {
  Float3 origin{}, direction{1, 0, 0};
  uint32_t surface = WT_NONE, left = WT_NONE, region = 0, entry = WT_NONE;
};

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
  HitList list = make_hit_list(context(), hits.size(), Trace::block_size(context().info()));
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
  std::vector<Hit> hits;  // default where not found
  std::vector<Ray> rays;  // afterwards
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

  // Returns what the plane WT_RAY_ENTRY then holds; hits and receptions one a ray.
  std::vector<uint32_t> put(std::span<const CachedRay> rays, std::span<const Hit> hits,
                            std::vector<uint32_t> receptions = {}) {
    RayQueue queue = upload(rays);
    const RayQueue missed = upload(rays);
    const HitList list = upload_hits(hits);
    HitList all = make_hit_list(context(), rays.size(), Trace::block_size(context().info()));
    std::vector<uint32_t> every(rays.size());
    std::iota(every.begin(), every.end(), 0u);
    receptions.resize(rays.size(), WT_NONE);
    const auto received = context().buffer(receptions, "receptions");
    store_(queue, missed, list, context().buffer(every, "indices"), all, table, static_surfaces, now, &received);
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

  void purge(uint32_t keep_from) { purge_(context(), table, keep_from); }
  // The counts since the last call.
  device::wt_cache_counters counters() {
    const device::wt_cache_counters counts = table.counters.read_one(0);
    table.counters.write(std::vector<device::wt_cache_counters>(1));
    return counts;
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
