// SPDX-License-Identifier: Apache-2.0
// Turns entries, and the rows of the setting whose entries they are, into one table: a row per entry and operation.
// Operations that have no time for each entry get a row at both ends of a region.
#include "study/buffer_views.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "study/entry_views.hpp"
#include "study/lookup_parts.hpp"
#include "study/ray_counts.hpp"
#include "study/table_regions.hpp"

namespace wavetracer::study {
namespace {

constexpr const char *of_write = "write", *of_read = "read", *of_call = "call of the buffer", *of_hash = "hash",
                     *of_trace = "trace";

// An operation that took this many times the mean was interrupted.
constexpr double interrupted = 1000;

constexpr const char* buffer_note =
    "nanoseconds per segment, from profiling events. Writes and reads are those of single entries: the clock of the "
    "compute unit, read before and after the last operation of an entry, says how they are spread, and their mean in a "
    "region of the table is what the events say; on a GPU it contains the time of other work-items that shared the "
    "unit, and a device without such a clock shows the mean alone. Entries that took more than 1,000 times the mean were "
    "interrupted, and are not drawn";
constexpr const char* parts_note =
    "hash and call of the buffer are parts of both write and read, and follow from look-ups of empty tables with each "
    "hash, as the mixed hash computes both others; the call of the buffer, in the thesis the address of an entry, is "
    "here what is left of such a look-up, with the reading of the ray and the first access to the table. A part that "
    "the noise makes negative is not drawn. Rays are traced in packets, so that tracing has one time in a region";

const EntrySummary* entries_of(const CacheRows& rows, const std::string& setting) {
  const CacheRow* counted = find_cached(rows, counted_name(setting), rows.front().rays, rows.front().drive);
  return counted ? &counted->entries : nullptr;
}

// The part of the table that belongs to one transmitter.
struct Part {
  const CacheRow& row;      // the row of the region, or of the whole frame if regions have none
  const EntryGroup* group;  // its entries; null if it has none
  uint32_t region, first_slot, last_slot;
};

std::vector<Part> parts_of(const CacheRows& rows, const CacheRow& whole, const EntrySummary& entries) {
  std::vector<Part> out;
  const std::vector<const CacheRow*> regions = regions_of(rows, whole.setting);
  for (const EntryGroup& group : entries.by_region) {
    const auto row =
        std::ranges::find_if(regions, [&](const CacheRow* one) { return one->region == group.number + 1; });
    Part part{row == regions.end() ? whole : **row, &group, group.number, 0, 0};
    bool found = false;
    for (const EntrySample& sample : entries.samples) {
      if (sample.region != group.number) continue;
      if (!found) part.first_slot = sample.slot;
      part.last_slot = sample.slot;
      found = true;
    }
    if (found) out.push_back(part);
  }
  // Nothing is known of single entries: the times stand for all of the table.
  if (out.empty())
    out.push_back({whole, nullptr, 0, 0, static_cast<uint32_t>(std::max<uint64_t>(whole.cache.entries, 1) - 1)});
  return out;
}

// Fills the table of one setting.
struct BufferTable {
  Csv& table;
  const CacheRow& whole;

  void add(const char* operation, const EntrySample& at, uint32_t cycles, double ns) {
    if (ns > 0)
      table.add(whole.drive, whole.setting, operation, at.slot, at.region, at.depth, at.hits, cycles, six_digits(ns));
  }
  void add_line(const char* operation, const Part& part, double ns) {
    for (const uint32_t slot : {part.first_slot, part.last_slot})
      add(operation, {.slot = slot, .region = part.region}, 0, ns);
  }
  // Adds an operation that has cycles for each entry, whose mean in this part is `mean`.
  void add_entries(const char* operation, const Part& part, const EntrySummary& entries, double mean,
                   uint32_t EntrySample::*cycles, double ns) {
    if (!(mean > 0)) return add_line(operation, part, ns);
    for (const EntrySample& sample : entries.samples)
      if (sample.region == part.region && sample.*cycles < interrupted * mean)
        add(operation, sample, sample.*cycles, ns * sample.*cycles / mean);
  }
};

void add_setting(const CacheRows& rows, const CacheRow& whole, bool traces, Csv& table) {
  static const EntrySummary no_entries;
  const EntrySummary* found = entries_of(rows, whole.setting);
  const EntrySummary& entries = found ? *found : no_entries;
  const LookupParts lookup = lookup_parts(rows, whole.setting);
  BufferTable out{table, whole};
  for (const Part& part : parts_of(rows, whole, entries)) {
    const EntryGroup group = part.group ? *part.group : EntryGroup{};
    out.add_entries(of_write, part, entries, group.write_cycles, &EntrySample::write_cycles, write_ns(part.row));
    out.add_entries(of_read, part, entries, group.read_cycles, &EntrySample::read_cycles, read_ns(part.row));
    out.add_line(of_call, part, lookup.buffer_call.value);
    out.add_line(of_hash, part, lookup.hash.value);
    if (traces) out.add_line(of_trace, part, trace_ns(part.row));
  }
}

// Returns the mean cycles of entries in the buckets themselves, and below them: of writes, then of reads.
std::vector<std::string> level_cells(const EntrySummary* entries) {
  if (!entries) return {"none", "none", "none", "none"};
  const Levels writes = write_levels(*entries), reads = read_levels(*entries);
  std::vector<std::string> out;
  for (const Measured& level : {writes.bucket, writes.below, reads.bucket, reads.below})
    out.push_back(std::isnan(level.value) ? "none" : plain(level.value));
  return out;
}

std::vector<std::string> part_cells(const LookupParts& parts) {
  std::vector<std::string> out;
  for (const Measured& part : {parts.buffer_call, parts.hash})
    out.push_back(std::isnan(part.value) ? "not measured" : part.value > 0 ? plain(part.value) : "below the noise");
  return out;
}

void append(std::vector<std::string>& cells, const std::vector<std::string>& more) {
  cells.insert(cells.end(), more.begin(), more.end());
}

NumberTable numbers_of(const CacheRows& rows, const BufferFigure& figure) {
  NumberTable out{
      .caption = fmt::format(
          "Nanoseconds per segment, at {} rays{}:", grouped(rows.front().rays),
          figure.by_region || figure.traces ? "" : ", and cycles of an entry in a bucket itself and below it"),
      .heads = {"setting"},
      .rows = {}};
  if (figure.by_region) append(out.heads, {"transmitter", "look-ups", "answered"});
  append(out.heads, {of_write, of_read, of_call, of_hash});
  if (figure.traces) out.heads.emplace_back(of_trace);
  const bool levels = !figure.by_region && !figure.traces;
  if (levels) append(out.heads, {"cycles of a write: bucket", "below", "of a read: bucket", "below"});
  for (const std::string& setting : figure.settings) {
    const CacheRow* whole = find_cached(rows, setting, rows.front().rays, rows.front().drive);
    if (!whole) continue;
    std::vector<const CacheRow*> shown = {whole};
    if (figure.by_region)
      for (const CacheRow* region : regions_of(rows, setting)) shown.push_back(region);
    for (const CacheRow* row : shown) {
      std::vector<std::string> cells = {setting};
      if (figure.by_region)
        append(cells, {row == whole ? "all" : row->transmitter, grouped(static_cast<uint64_t>(row->counts.lookups)),
                       share_words(hit_rate(*row))});
      append(cells, {plain(write_ns(*row)), plain(read_ns(*row))});
      append(cells, row == whole ? part_cells(lookup_parts(rows, setting)) : std::vector<std::string>{"", ""});
      if (figure.traces) cells.push_back(plain(trace_ns(*row)));
      if (levels) append(cells, level_cells(entries_of(rows, setting)));
      out.rows.push_back(cells);
    }
  }
  return out;
}

}  // namespace

CacheView along_buffer(const BufferFigure& figure) {
  return [=](const CacheMeasurement& measured) {
    const CacheRows& rows = measured.rows;
    CacheShown out{
        .plot = {.settings = {of_write, of_read, of_call, of_hash},
                 .line_column = "operation",
                 .panel_column = "setting",
                 .x = "slot",
                 .x_label = "place in the table",
                 .x_in_thousands = true,
                 .points = true,
                 .joined = {of_call, of_hash, of_trace},
                 .point_size = 0.25},
        .table = Csv({"drive", "setting", "operation", "slot", "region", "tree_depth", "hits", "cycles", "ns"}),
        .numbers = numbers_of(rows, figure),
        .notes = {buffer_note, parts_note}};
    if (figure.traces) out.plot.settings.emplace_back(of_trace);
    for (const std::string& setting : figure.settings) {
      const CacheRow* whole = find_cached(rows, setting, rows.front().rays, rows.front().drive);
      if (!whole) continue;
      const size_t before = out.table.text().size();
      add_setting(rows, *whole, figure.traces, out.table);
      if (out.table.text().size() > before) out.plot.panels.push_back({setting, "ns", "ns per segment", setting, true});
    }
    return out;
  };
}

}  // namespace wavetracer::study
