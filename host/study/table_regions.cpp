// SPDX-License-Identifier: Apache-2.0
// Turns rows of one region each into a plot, a table and verdicts.
// Rows are those of add_regions() of cache_study.cpp.
#include "study/table_regions.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include "study/entry_views.hpp"
#include "study/ray_counts.hpp"
#include "study/statistics.hpp"

namespace wavetracer::study {
namespace {

constexpr double clear_correlation = 0.5;
constexpr const char* regions_note =
    "nanoseconds of a region are those of the rays of its transmitter alone, in the same table, "
    "and region 0 is the rays of all; cycles are means over the entries of a region, by the device's own clock, "
    "in a frame of all transmitters. The hash is part of both read and write. The thesis' buffer call, "
    "the address of an entry, has no counterpart; what a table costs besides is the gathering of missed rays";

// Returns the rows of a setting at the first number of rays.
std::vector<const CacheRow*> regions_of(const CacheRows& rows, const std::string& setting) {
  std::vector<const CacheRow*> out;
  for (const CacheRow& row : rows)
    if (row.setting == setting && row.region > 0 && row.rays == rows.front().rays && row.drive == rows.front().drive)
      out.push_back(&row);
  return out;
}

void add_row(CacheShown& shown, const CacheRows& rows, const CacheRow& row, bool with_trace) {
  const EntryGroup* entries = row.region == 0 ? nullptr : entries_of_region(rows, row, row.region - 1);
  shown.table.add(row.drive, row.setting, row.region, six_digits(row.counts.lookups), six_digits(hit_rate(row)),
                  six_digits(write_ns(row)), six_digits(read_ns(row)), six_digits(gather_ns(row)),
                  six_digits(trace_ns(row)), six_digits(entries ? entries->write_cycles : undefined),
                  six_digits(entries ? entries->read_cycles : undefined));
  shown.numbers.rows.push_back({row.setting, row.region == 0 ? "all" : row.transmitter,
                                grouped(static_cast<uint64_t>(row.counts.lookups)), share_words(hit_rate(row)),
                                plain(write_ns(row)), plain(read_ns(row)), plain(gather_ns(row))});
  if (with_trace) shown.numbers.rows.back().push_back(plain(trace_ns(row)));
}

}  // namespace

double region_lookups(const CacheRow& row) { return row.counts.lookups; }
double access_ns(const CacheRow& row) { return write_ns(row) + read_ns(row); }

CacheView regions(std::vector<std::string> settings, bool with_trace) {
  return [=](const CacheMeasurement& measured) {
    const CacheRows& rows = measured.rows;
    CacheShown out{
        .plot = {.settings = settings,
                 .x = "region",
                 .x_label = "region of the table, one for each transmitter (0: all)",
                 .points = true,
                 .panels_a_row = with_trace ? 2u : 3u,
                 .panels = panels_of(rows, {{"write (cache_store)", "write_ns", "ns per segment", "", with_trace},
                                            {"read (cache_lookup)", "read_ns", "ns per segment", "", with_trace},
                                            {"gather missed rays", "gather_ns", "ns per segment", "", with_trace}})},
        .table = Csv({"drive", "setting", "region", "lookups", "hit_rate", "write_ns", "read_ns", "gather_ns",
                      "trace_ns", "write_cycles", "read_cycles"}),
        .numbers = {.caption = fmt::format("Nanoseconds per segment, at {} rays:", grouped(rows.front().rays)),
                    .heads = {"setting", "transmitter", "look-ups", "answered", "write", "read", "gather"},
                    .rows = {}},
        .notes = {regions_note}};
    const std::string& drive = rows.front().drive;
    if (!with_trace) {
      out.plot.panels_a_row = 2;
      out.plot.panels.push_back({"write, inside the table", "write_cycles", "cycles", drive});
      out.plot.panels.push_back({"read, inside the table", "read_cycles", "cycles", drive});
    }
    if (with_trace) {
      out.numbers.heads.emplace_back("trace");
      const auto traced = panels_of(rows, {{"trace", "trace_ns", "ns per segment", "", true}});
      out.plot.panels.insert(out.plot.panels.end(), traced.begin(), traced.end());
    }
    for (const std::string& setting : settings) {
      const CacheRow* whole = find_cached(rows, setting, rows.front().rays, rows.front().drive);
      if (whole) add_row(out, rows, *whole, with_trace);
      for (const CacheRow* row : regions_of(rows, setting)) add_row(out, rows, *row, with_trace);
    }
    return out;
  };
}

namespace {

// Two values of each region.
struct RegionPairs {
  std::vector<double> a, b;
};

Judge<CacheRow> correlated(std::vector<std::string> settings,
                           std::function<RegionPairs(const CacheRows&, const std::string&)> pairs, bool opposite) {
  return [=](const CacheRows& rows) {
    Cases out{.form = correlation_form()};
    for (const std::string& setting : settings) {
      const RegionPairs regions = pairs(rows, setting);
      const double found = regions.a.size() < 3 ? undefined : pearson(regions.a, regions.b);
      if (!std::isnan(found))
        out.all.push_back({'"' + setting + '"', 0, correlates(opposite ? -found : found, regions.a.size()), found});
    }
    return out;
  };
}

}  // namespace

Answer correlates(double coefficient, size_t pairs) {
  if (std::isnan(coefficient)) return Answer::absent;
  if (pairs <= 3) return Answer::undecided;
  // Transformed coefficients are normal, with a standard error of one over the root of n - 3.
  const double error = 1 / std::sqrt(static_cast<double>(pairs) - 3),
               // Rounding makes coefficients of exact lines larger than 1.
      distance = std::atanh(std::clamp(coefficient, -1.0, 1.0)) - std::atanh(clear_correlation);
  if (std::abs(distance) <= noise_factor * error) return Answer::undecided;
  return distance > 0 ? Answer::yes : Answer::no;
}

Judge<CacheRow> across_regions(std::vector<std::string> settings, RegionValue value, RegionValue with, bool opposite) {
  const auto pairs = [=](const CacheRows& rows, const std::string& setting) {
    RegionPairs out;
    for (const CacheRow* row : regions_of(rows, setting)) {
      out.a.push_back(value(*row));
      out.b.push_back(with(*row));
    }
    return out;
  };
  return correlated(std::move(settings), pairs, opposite);
}

Judge<CacheRow> across_entries(std::vector<std::string> settings, double EntryGroup::*cycles) {
  const auto pairs = [=](const CacheRows& rows, const std::string& setting) {
    RegionPairs out;
    const CacheRow* row = find_cached(rows, setting, rows.front().rays, rows.front().drive);
    if (!row) return out;
    for (const EntryGroup& region : row->entries.by_region) {
      if (std::isnan(region.*cycles)) continue;
      out.a.push_back(static_cast<double>(region.hits));
      out.b.push_back(region.*cycles);
    }
    return out;
  };
  return correlated(std::move(settings), pairs, false);
}

}  // namespace wavetracer::study
