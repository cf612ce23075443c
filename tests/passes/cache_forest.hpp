// SPDX-License-Identifier: Apache-2.0
// The chained table, and its trees in memory as the host reads them: number of nodes, their order, their buckets. The
// surface of a ray follows from the primitive that it left, see surface_of.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <set>
#include <vector>

#include "passes/cached_rays.hpp"

namespace wavetracer::test {

inline CacheConfig chained(uint64_t entries, double load_factor = 3, uint32_t method = 3) {
  CacheConfig config;
  config.kind = "chained";
  config.buffer_size = entries;
  config.load_factor = load_factor;
  config.hash_method = method;
  config.hit_point = "cached";  // answers are exactly the stored hits
  return config;
}

// All trees as the host finds them.
struct Forest {
  size_t nodes = 0, wrong_bucket = 0, out_of_order = 0;
  uint32_t deepest = 0;
  std::set<uint32_t> slots;

  explicit Forest(const CacheTable& table) : table_(table), entries_(table.entries.read()), heads_(table.heads.read()) {
    for (uint32_t r = 0; r < table.regions.size(); ++r)
      for (uint32_t b = 0; b < table.regions[r].buckets; ++b) {
        region_ = table.regions[r];
        bucket_ = b;
        last_ = {};
        first_ = true;
        walk(heads_[region_.first_bucket + b], 1);
      }
  }

 private:
  using Key = std::array<uint64_t, 6>;
  const CacheTable& table_;
  std::vector<device::wt_cache_entry> entries_;
  std::vector<uint32_t> heads_;
  device::wt_cache_region region_{};
  uint32_t bucket_ = 0;
  Key last_{};
  bool first_ = true;

  static uint64_t pair(float low, float high) {
    return std::bit_cast<uint32_t>(low) | uint64_t{std::bit_cast<uint32_t>(high)} << 32;
  }

  Key key_of(const device::wt_cache_entry& e) const {
    uint64_t x = e.cells ^ e.left * 0x9E3779B97F4A7C15u;
    x = (x ^ x >> 33) * 0xFF51AFD7ED558CCDu;
    x = (x ^ x >> 33) * 0xC4CEB9FE1A85EC53u;
    Key key{x ^ x >> 33, e.cells, e.left};
    if (table_.config.exact()) {
      key[3] = pair(e.origin[0], e.origin[1]);
      key[4] = pair(e.origin[2], e.direction[0]);
      key[5] = pair(e.direction[1], e.direction[2]);
    }
    return key;
  }

  // Visits the tree in order: keys ascend strictly, so that no key is there twice.
  void walk(uint32_t slot, uint32_t depth) {
    if (slot == WT_NONE) return;
    const size_t links = table_.regions.size() * region_.buckets + 2 * size_t{slot};
    REQUIRE(slot - region_.first_entry < region_.entries);
    REQUIRE(slots.insert(slot).second);
    walk(heads_[links], depth + 1);
    const device::wt_cache_entry& e = entries_[slot];
    const uint64_t hash =
        device::wt_cache_hash(table_.config.hash_method, e.cells, e.left, surface_of(e.left), table_.widths);
    wrong_bucket += device::wt_cache_bucket(hash, region_.buckets) != bucket_;
    const Key key = key_of(e);
    out_of_order += !first_ && !(last_ < key);
    first_ = false;
    last_ = key;
    ++nodes;
    deepest = std::max(deepest, depth);
    walk(heads_[links + 1], depth + 1);
  }
};

inline void check_whole(const Forest& forest, size_t nodes) {
  CHECK(forest.nodes == nodes);
  CHECK(forest.wrong_bucket == 0);
  CHECK(forest.out_of_order == 0);
}

}  // namespace wavetracer::test
