// SPDX-License-Identifier: Apache-2.0
// Turns entries into tables and plots.
// A study must have both a setting and its counted twin.
#include "study/entry_views.hpp"
#include <fmt/format.h>
#include <cmath>
#include "study/ray_counts.hpp"
#include "study/statistics.hpp"

namespace wavetracer::study {
namespace {

constexpr const char* cycles_note =
    "cycles are those of the clock of the compute unit that did the operation, read before and after it: "
    "the mean over the middle nine tenths of the entries of a depth, for each its last operation; "
    "on a GPU they contain the time of other work-items that shared the unit, and a device without such "
    "a clock shows none";

const CacheRow* counted_row(const CacheMeasurement& measured, const std::string& setting) {
  const CacheRow& first = measured.rows.front();
  return find_cached(measured.rows, counted_name(setting), first.rays, first.drive);
}

// Returns the value in the buckets themselves, and the average below them.
std::string levels(const std::vector<EntryGroup>& depths, double EntryGroup::*cycles, bool below) {
  double sum = 0, entries = 0;
  for (const EntryGroup& group : depths) {
    if (std::isnan(group.*cycles) || (group.number > 1) != below) continue;
    sum += static_cast<double>(group.entries) * group.*cycles;
    entries += static_cast<double>(group.entries);
  }
  return entries > 0 ? plain(sum / entries) : "none";
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

CacheView operations_by_tree_depth(std::vector<std::string> settings) {
  return [=](const CacheMeasurement& measured) {
    const CacheRow& first = measured.rows.front();
    CacheShown out{.plot = {.settings = settings,
                            .x = "tree_depth",
                            .x_label = "depth of the entry in the tree of its bucket (1: the bucket itself)",
                            .panels = {{"write", "write_cycles", "cycles", first.drive, true},
                                       {"read", "read_cycles", "cycles", first.drive, true}}},
                   .table = Csv({"drive", "setting", "tree_depth", "entries", "hits", "write_cycles", "read_cycles"}),
                   .numbers = {.caption = fmt::format("Nanoseconds per segment at {} rays, and cycles of an entry in "
                                                      "a bucket itself and below it:",
                                                      grouped(first.rays)),
                               .heads = {"setting", "write", "read", "gather", "cycles of a write: bucket", "below",
                                         "of a read: bucket", "below"},
                               .rows = {}},
                   .notes = {cycles_note}};
    for (const std::string& setting : settings) {
      const CacheRow* row = find_cached(measured.rows, setting, first.rays, first.drive);
      const CacheRow* counted = counted_row(measured, setting);
      if (!row || !counted) continue;
      const std::vector<EntryGroup>& depths = counted->entries.by_depth;
      for (const EntryGroup& group : depths)
        out.table.add(row->drive, setting, group.number, group.entries, group.hits, group.write_cycles,
                      group.read_cycles);
      out.numbers.rows.push_back(
          {setting, plain(write_ns(*row)), plain(read_ns(*row)), plain(gather_ns(*row)),
           levels(depths, &EntryGroup::write_cycles, false), levels(depths, &EntryGroup::write_cycles, true),
           levels(depths, &EntryGroup::read_cycles, false), levels(depths, &EntryGroup::read_cycles, true)});
    }
    return out;
  };
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
