// SPDX-License-Identifier: Apache-2.0
// A table of the ray cache with the kernels of probe_cache.cl, for tests and bench_cache.
// Keys are numbers; the value stored under a key follows from it, so that kernels can check it themselves.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "passes/cache_table.hpp"
#include "passes/on_device.hpp"

namespace wavetracer::test {

using device::wt_cache_counters;
using device::wt_cache_entry;
using device::wt_cache_region;

struct TableKind {
  CacheKind kind;
  CacheLocking locking;
  CacheKey key;
  std::string name() const { return kind.text() + (kind == "open" ? ", " + locking.text() : "") + ", " + key.text(); }
  CacheConfig config(uint64_t entries) const {
    CacheConfig config;
    config.kind = kind;
    config.locking = locking;
    config.key = key;
    config.buffer_size = entries;
    return config;
  }
};

inline std::vector<TableKind> table_kinds(CacheKind kind) {
  std::vector<TableKind> kinds;
  for (const CacheKey key : std::to_array<CacheKey>({"quantised", "exact"})) {
    kinds.push_back({kind, "readers", key});
    if (kind == "open") kinds.push_back({kind, "mutex", key});
  }
  return kinds;
}

// Kernels of probe_cache.cl over one table.
class CacheProbe {
 public:
  CacheTable table;

  CacheProbe(gpu::Context& context, const CacheConfig& config, uint32_t regions)
      : table(make_cache_table(context, config, regions, 1u << 20, 1u << 20)),
        context_(context),
        region_count_(regions),
        outcome_(context.buffer(std::vector<uint32_t>(4), "outcome")) {}
  CacheProbe(const CacheConfig& config, uint32_t regions) : CacheProbe(context(), config, regions) {}

  // Runs a kernel, whose first arguments are the table.
  template <class... Args>
  void run(const char* name, size_t items, const Args&... args) {
    context_.kernel("probe_cache", name, table.definitions(false))({items, 64}, Stage::transfer, table.entries,
                                                                   table.heads, table.used, table.device_regions,
                                                                   table.counters, args...);
  }

  struct Outcome {
    uint32_t puts, finds, hits, wrong;
    std::vector<uint32_t> slots;  // for each key: result of its put, or WT_NONE
    double seconds;               // time of the kernel, by the device's clock
  };
  Outcome mixed(uint64_t operations, uint32_t universe) {
    auto slots = no_slots(universe);
    context_.fill(outcome_, 0);
    context_.reset_profile();
    run("mixed_operations", static_cast<size_t>(operations / 16 + 1), region_count_, table.widths, operations, universe,
        slots, outcome_);
    const std::vector<uint32_t> o = outcome_.read();
    return {o[0], o[1], o[2], o[3], slots.read(), context_.profile().at("transfer")};
  }

  static constexpr uint32_t wrong_answer = WT_NONE - 1;
  // Returns for the keys 0 .. universe - 1 where each is found, WT_NONE, or wrong_answer.
  std::vector<uint32_t> find_keys(uint32_t universe) {
    auto slots = no_slots(universe);
    run("find_keys", universe, region_count_, table.widths, universe, slots);
    return slots.read();
  }

  // Returns the results of the puts.
  std::vector<uint32_t> put_keys(uint32_t first, uint32_t count, uint32_t now) {
    auto slots = no_slots(first + count);
    run("put_keys", count, region_count_, table.widths, first, count, now, slots);
    return slots.read(first, count);
  }

  void remove(const std::vector<uint32_t>& slots) {
    run("remove_slots", slots.size(), context_.buffer(slots, "removed slots"), static_cast<uint32_t>(slots.size()));
  }

  // Puts or finds one labelled ray by itself: the primitive of its hit goes in or comes out (WT_NONE: nothing).
  uint32_t put(const Ray& ray, uint32_t left, uint32_t now, uint32_t primitive) {
    auto slot = no_slots(1);
    const RayQueue queue = labelled(ray, left);
    run("put_rays", 1, table.widths, queue.planes, queue.capacity, 1u, now,
        context_.buffer(std::vector{primitive}, "primitive"), slot);
    return slot.read_one(0);
  }
  uint32_t find(const Ray& ray, uint32_t left, uint32_t now) {
    auto primitive = no_slots(1);
    const RayQueue queue = labelled(ray, left);
    run("find_rays", 1, table.widths, queue.planes, queue.capacity, 1u, now, primitive);
    return primitive.read_one(0);
  }

  // Entries written before this frame become stale.
  void set_since(uint32_t since) {
    for (wt_cache_region& region : table.regions) region.since = since;
    table.device_regions.write(table.regions);
  }

  wt_cache_counters counters() const { return table.counters.read_one(0); }

 private:
  gpu::Context& context_;
  uint32_t region_count_;
  gpu::Buffer<uint32_t> outcome_;

  gpu::Buffer<uint32_t> no_slots(uint32_t count) {
    return context_.buffer(std::vector<uint32_t>(count, WT_NONE), "slots");
  }

  RayQueue labelled(const Ray& ray, uint32_t left) {
    RayQueue queue = make_ray_queue(context_, 1, "labelled ray", WT_RAY_LABELLED_PLANES);
    const auto set = [&](size_t plane, float value) { queue.planes.write(std::vector{value}, plane * queue.capacity); };
    for (size_t axis = 0; axis < 3; ++axis) {
      set(WT_RAY_ORIGIN + axis, ray.origin[axis]);
      set(WT_RAY_DIRECTION + axis, ray.direction[axis]);
    }
    set(WT_RAY_SURFACE, std::bit_cast<float>(ray.surface));
    set(WT_RAY_LEFT, std::bit_cast<float>(left));
    set(WT_RAY_REGION, std::bit_cast<float>(0u));
    queue.count = 1;
    return queue;
  }
};

}  // namespace wavetracer::test
