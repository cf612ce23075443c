// SPDX-License-Identifier: Apache-2.0
// Turns entries into tables and plots.
// A study must have both a setting and its counted twin.
#include "study/entry_views.hpp"
#include "study/ray_counts.hpp"

namespace wavetracer::study {
namespace {

const CacheRow* counted_row(const CacheMeasurement& measured, const std::string& setting) {
  const CacheRow& first = measured.rows.front();
  return find_cached(measured.rows, counted_name(setting), first.rays, first.drive);
}

}  // namespace

std::string counted_name(const std::string& setting) { return setting + " counted"; }

Setting counted(Setting setting) {
  return {.name = counted_name(setting.name),
          .apply =
              [apply = setting.apply](Config& config) {
                apply(config);
                config.cache.statistics = config.output.cache_entries = true;
              },
          .whole_only = true};
}

CacheView hits_along_table(std::vector<std::string> settings) {
  return [=](const CacheMeasurement& measured) {
    const std::string& drive = measured.rows.front().drive;
    CacheShown out{.plot = {.settings = settings,
                            .x = "first_slot",
                            .x_label = "place in the table",
                            .panels_a_row = 1,
                            .panels = {{"hits of an entry, on average over runs of entries", "hits", "hits", drive}}},
                   .table = Csv({"drive", "setting", "first_slot", "entries", "hits"}),
                   .numbers = {.caption = "Entries of the table and their hits. If chance alone spread them, "
                                          "both numbers would be about 1:",
                               .heads = {"setting", "all", "that hold a segment", "of these, that never answered",
                                         "variance of hits over mean", "clustering of hits"},
                               .rows = {}}};
    for (const std::string& setting : settings) {
      const CacheRow* row = counted_row(measured, setting);
      if (!row || row->cache.entries_by_hits.empty()) continue;
      for (const SlotRun& run : row->entries.runs)
        out.table.add(drive, setting, run.first_slot, run.entries, six_digits(run.hits));
      out.numbers.rows.push_back({setting, grouped(row->cache.entries), grouped(entries_used(*row)),
                                  grouped(row->cache.entries_by_hits.front()), plain(row->entries.dispersion),
                                  plain(row->entries.clustering)});
    }
    return out;
  };
}

const EntryGroup* entries_of_region(const std::vector<CacheRow>& rows, const CacheRow& row, uint32_t region) {
  const CacheRow* counted = find_cached(rows, counted_name(row.setting), row.rays, row.drive);
  if (!counted) return nullptr;
  for (const EntryGroup& group : counted->entries.by_region)
    if (group.number == region) return &group;
  return nullptr;
}

}  // namespace wavetracer::study
