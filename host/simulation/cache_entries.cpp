// SPDX-License-Identifier: Apache-2.0
// Depths of entries come from a walk over the trees of the chained tables; in the other kinds a search has one step. In
// a tree that races of the thesis' table have damaged, the walk may meet an entry twice: its first depth counts.
#include "simulation/cache_entries.hpp"
#include <stdexcept>
#include <utility>

namespace wavetracer {
namespace {

using namespace device;

constexpr Stage read_stage = Stage::cache_purge;
constexpr uint32_t removed_tag = 1;  // WT_CACHE_REMOVED of lib/cache_concurrent.clh; 0 is a free one

struct Tables {
  const CacheTable& table;
  std::vector<wt_cache_entry> entries;
  std::vector<uint32_t> heads, depths;

  bool is_written(uint32_t slot) const { return entries[slot].version != 0; }

  // The two links of an entry are side by side.
  size_t links_at(uint32_t slot) const {
    if (table.config.as_printed()) return 3 * size_t{slot};
    return table.regions.size() * table.regions.front().buckets + 2 * size_t{slot};
  }

  void walk(uint32_t root) {
    std::vector<std::pair<uint32_t, uint32_t>> waiting = {{root, 1}};
    while (!waiting.empty()) {
      const auto [slot, depth] = waiting.back();
      waiting.pop_back();
      if (slot == WT_NONE || depths[slot] != 0) continue;
      depths[slot] = depth;
      for (const size_t side : {0, 1}) waiting.emplace_back(heads[links_at(slot) + side], depth + 1);
    }
  }

  void walk_trees() {
    for (const wt_cache_region& region : table.regions)
      for (uint32_t bucket = 0; bucket < region.buckets; ++bucket) {
        if (table.config.pooled())
          walk(heads[region.first_bucket + bucket]);
        else if (is_written(region.first_entry + bucket))
          walk(region.first_entry + bucket);
      }
  }

  void find_depths() {
    depths.assign(entries.size(), 0);
    if (table.config.linked()) return walk_trees();
    for (uint32_t slot = 0; slot < entries.size(); ++slot)
      depths[slot] = !table.config.in_buckets() || heads[slot] > removed_tag ? 1 : 0;
  }
};

}  // namespace

void add_cache_entries(const CacheTable& table, uint32_t frame, uint32_t now, CacheEntryRows& rows) {
  if (!table.config.statistics) throw std::logic_error("cache entries: the table keeps no statistics");
  Tables found{table,
               table.entries.read(0, table.entries.size(), read_stage),
               table.heads.read(0, table.heads.size(), read_stage),
               {}};
  const std::vector<uint32_t> hits = table.hits.read(0, table.hits.size(), read_stage);
  const std::vector<wt_cache_cycles> cycles = table.cycles.read(0, table.cycles.size(), read_stage);
  found.find_depths();
  for (uint32_t region = 0; region < table.regions.size(); ++region) {
    const wt_cache_region& part = table.regions[region];
    for (uint32_t slot = part.first_entry; slot < part.first_entry + part.entries; ++slot) {
      const wt_cache_entry& entry = found.entries[slot];
      if (!found.is_written(slot) || (table.config.in_buckets() && found.depths[slot] == 0)) continue;
      rows.frame.push_back(frame);
      rows.slot.push_back(slot);
      rows.region.push_back(region);
      rows.depth.push_back(found.depths[slot]);
      rows.hits.push_back(hits[slot]);
      rows.age.push_back(entry.time == WT_NONE ? WT_NONE : now - entry.time);
      rows.length_m.push_back(entry.t);
      rows.read_cycles.push_back(cycles[slot].read);
      rows.write_cycles.push_back(cycles[slot].write);
    }
  }
}

}  // namespace wavetracer
