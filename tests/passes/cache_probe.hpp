// What the tests of the ray cache's tables share: a table with the kernels of probe_cache.cl, and mixed operations
// beside a model of them that runs in sequence. Assumes on_device.hpp's context.
#pragma once
#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

#include "passes/cache_table.hpp"
#include "passes/on_device.hpp"

namespace wavetracer::test {

using device::wt_cache_counters;
using device::wt_cache_entry;
using device::wt_cache_region;

struct TableKind {
  std::string kind, locking, key;
  std::string name() const { return kind + (kind == "open" ? ", " + locking : "") + ", " + key; }
  CacheConfig config(uint64_t entries) const {
    CacheConfig config;
    config.kind = kind;
    config.locking = locking;
    config.key = key;
    config.buffer_size = entries;
    return config;
  }
};

inline std::vector<TableKind> table_kinds(const std::string& kind) {
  std::vector<TableKind> kinds;
  for (const char* key : {"quantised", "exact"}) {
    kinds.push_back({kind, "readers", key});
    if (kind == "open") kinds.push_back({kind, "mutex", key});
  }
  return kinds;
}

// Kernels of probe_cache.cl over one table.
class CacheProbe {
 public:
  CacheTable table;

  CacheProbe(const CacheConfig& config, uint32_t regions)
      : table(make_cache_table(context(), config, regions, 1u << 20, 1u << 20)),
        region_count_(regions),
        outcome_(context().buffer(std::vector<uint32_t>(4), "outcome")) {}

  // Runs a kernel, whose first arguments are the table.
  template <class... Args>
  void run(const char* name, size_t items, const Args&... args) {
    context().kernel("probe_cache", name, table.definitions(false))(
        {items, 64}, "probe", table.entries, table.heads, table.used, table.device_regions, table.counters, args...);
  }

  struct Outcome {
    uint32_t puts, finds, hits, wrong;
    std::vector<uint32_t> slots;  // a key: what a put of it returned, or WT_NONE
  };
  Outcome mixed(uint64_t operations, uint32_t universe) {
    auto slots = no_slots(universe);
    context().fill(outcome_, 0);
    run("mixed_operations", static_cast<size_t>((operations + 15) / 16), region_count_, table.widths, operations,
        universe, slots, outcome_);
    const std::vector<uint32_t> o = outcome_.read();
    return {o[0], o[1], o[2], o[3], slots.read()};
  }

  // Of keys 0 .. universe - 1: where each is found. Answers that are wrong fail the test.
  std::vector<uint32_t> find_keys(uint32_t universe) {
    auto slots = no_slots(universe);
    run("find_keys", universe, region_count_, table.widths, universe, slots);
    std::vector<uint32_t> found = slots.read();
    CHECK(std::count(found.begin(), found.end(), WT_NONE - 1) == 0);
    return found;
  }

  // What the puts returned.
  std::vector<uint32_t> put_keys(uint32_t first, uint32_t count, uint32_t now) {
    auto slots = no_slots(first + count);
    run("put_keys", count, region_count_, table.widths, first, count, now, slots);
    return slots.read(first, count);
  }

  void remove(const std::vector<uint32_t>& slots) {
    run("remove_slots", slots.size(), context().buffer(slots, "removed slots"), static_cast<uint32_t>(slots.size()));
  }

  // One labelled ray, by itself: the hit's primitive that it is given, and what it is answered (WT_NONE: nothing).
  uint32_t put(const Ray& ray, uint32_t left, uint32_t now, uint32_t primitive) {
    auto slot = no_slots(1);
    const RayQueue queue = labelled(ray, left);
    run("put_rays", 1, table.widths, queue.planes, queue.capacity, 1u, now,
        context().buffer(std::vector{primitive}, "primitive"), slot);
    return slot.read_one(0);
  }
  uint32_t find(const Ray& ray, uint32_t left, uint32_t now) {
    auto primitive = no_slots(1);
    const RayQueue queue = labelled(ray, left);
    run("find_rays", 1, table.widths, queue.planes, queue.capacity, 1u, now, primitive);
    return primitive.read_one(0);
  }

  // Entries of before this frame are stale.
  void set_since(uint32_t since) {
    for (wt_cache_region& region : table.regions) region.since = since;
    table.device_regions.write(table.regions);
  }

  wt_cache_counters counters() const { return table.counters.read_one(0); }

 private:
  uint32_t region_count_;
  gpu::Buffer<uint32_t> outcome_;

  static gpu::Buffer<uint32_t> no_slots(uint32_t count) {
    return context().buffer(std::vector<uint32_t>(count, WT_NONE), "slots");
  }

  static RayQueue labelled(const Ray& ray, uint32_t left) {
    RayQueue queue = make_ray_queue(context(), 1, "labelled ray", WT_RAY_LABELLED_PLANES);
    const auto set = [&](size_t plane, float value) {
      queue.planes.write(std::vector{value}, plane * queue.capacity);
    };
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

// SplitMix64, as mixed_operations draws its operations.
inline uint64_t split_mix(uint64_t i) {
  uint64_t x = i * 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

// The same operations in sequence: how many are puts, and of which keys.
struct SequentialModel {
  uint64_t puts = 0;
  std::vector<bool> was_put;

  SequentialModel(uint64_t operations, uint32_t universe) : was_put(universe) {
    for (uint64_t i = 0; i < operations; ++i) {
      const uint64_t random = split_mix(i);
      if ((random >> 3 & 3) != 0) continue;
      const uint64_t most = (random & 7) == 0 ? std::min(universe, 64u) : universe;
      was_put[(random >> 32) * most >> 32] = true;
      ++puts;
    }
  }
};

// Mixed operations over keys of which `load` times the table's entries may be stored; what is in it afterwards must be
// what some order of the operations leaves.
inline void check_mixed(const TableKind& kind, uint64_t operations, uint64_t entries, double load) {
  CAPTURE(kind.name());
  CAPTURE(load);
  constexpr uint32_t regions = 3;
  CacheConfig config = kind.config(entries);
  config.purge = "precision";  // of quantised keys: an entry of another frame does not stand, see probe_cache.cl
  config.residual_value = 0.5;
  CacheProbe probe(config, regions);
  const auto universe = static_cast<uint32_t>(load * static_cast<double>(entries));
  const SequentialModel model(operations, universe);
  const CacheProbe::Outcome outcome = probe.mixed(operations, universe);
  CHECK(outcome.wrong == 0);
  CHECK(outcome.puts == model.puts);
  CHECK(outcome.puts + outcome.finds == operations);
  CHECK(outcome.hits > operations / 50);

  const wt_cache_counters counters = probe.counters();
  CHECK(counters.stored + counters.duplicates + counters.dropped == model.puts);
  CHECK(counters.exhausted <= counters.dropped);
  CHECK(counters.replaced <= counters.stored);
  if (kind.key == "quantised") CHECK(counters.replaced > model.puts / 10);
  const uint32_t kept = counters.stored - counters.replaced;

  const std::vector<uint32_t> found = probe.find_keys(universe);
  const std::vector<wt_cache_entry> table = probe.table.entries.read();
  size_t never_put = 0, lost = 0, count = 0;
  for (uint32_t key = 0; key < universe; ++key) {
    count += found[key] != WT_NONE;
    never_put += found[key] != WT_NONE && !model.was_put[key];
    if (outcome.slots[key] == WT_NONE) continue;
    // Of an open table others may have taken the slot since; never does it become empty.
    lost += kind.kind == "open" ? table[outcome.slots[key]].version == 0 : found[key] != outcome.slots[key];
  }
  CHECK(never_put == 0);
  CHECK(lost == 0);
  if (kind.kind != "open") CHECK(count == kept);  // more were kept than are found where a key is there twice
  if (kind.kind == "chained") return;             // whose pool also has entries that no tree took

  std::set<uint32_t> keys;
  size_t written = 0;
  for (const wt_cache_entry& entry : table) {
    if (entry.version == 0) continue;
    ++written;
    never_put += entry.next >= universe || !model.was_put[entry.next];
    keys.insert(entry.next);
  }
  CHECK(never_put == 0);
  CHECK(written == kept);
  CHECK(keys.size() == kept);
}

}  // namespace wavetracer::test
