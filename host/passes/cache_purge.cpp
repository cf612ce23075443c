// SPDX-License-Identifier: Apache-2.0
// Host side of kernels/cache/cache_purge.cl.
// A work-item takes a run of entries; regions are the second dimension.
#include "passes/cache_purge.hpp"

#include <algorithm>
#include <vector>

namespace wavetracer {

CachePurge::CachePurge(gpu::Context& context, const CacheTable& table)
    : old_(context.buffer<uint32_t>(table.regions.size(), "old cache entries")),
      work_(tuning_of(context.info()).cache_entries) {
  gpu::Definitions definitions = table.definitions(true);
  definitions["WT_ENTRIES_PER_ITEM"] = work_.option();
  kernel_ = {context, definitions};
}

void CachePurge::operator()(gpu::Context& context, CacheTable& table, uint32_t keep_from) {
  context.fill(old_, 0, Stage::cache_purge);
  const gpu::Range entries = work_.range(table.regions.front().entries);
  kernel_({{entries.global[0], table.regions.size(), 1}, entries.local, 2}, Stage::cache_purge,
          calls::cache_purge::cache_purge{.entries = table.entries,
                                          .heads = table.heads,
                                          .used = table.used,
                                          .regions = table.device_regions,
                                          .counters = table.counters,
                                          .keep_from = keep_from,
                                          .old = old_,
                                          .uses = table.uses});
  if (table.config.pooled()) clear_old_regions(context, table);
}

void CachePurge::clear_old_regions(gpu::Context& context, CacheTable& table) {
  const std::vector<uint32_t> old = old_.read(0, old_.size(), Stage::cache_purge);
  const std::vector<uint32_t> used = table.used.read(0, table.used.size(), Stage::cache_purge);
  std::vector counters{table.counters.read_one(0, Stage::cache_purge)};
  for (uint32_t r = 0; r < table.regions.size(); ++r) {
    const uint32_t filled = std::min(used[r], table.regions[r].entries);
    if (2 * uint64_t{old[r]} <= filled) continue;
    counters[0].evicted += filled;
    table.clear(context, r);
  }
  table.counters.write(counters, 0, Stage::cache_purge);
}

}  // namespace wavetracer
