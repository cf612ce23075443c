// SPDX-License-Identifier: Apache-2.0
// Turns rows of one region each into verdicts.
// Rows are those of add_regions() of cache_study.cpp.
#include "study/table_regions.hpp"
#include <algorithm>
#include <cmath>
#include "study/statistics.hpp"

namespace wavetracer::study {
std::vector<const CacheRow*> regions_of(const CacheRows& rows, const std::string& setting) {
  std::vector<const CacheRow*> out;
  for (const CacheRow& row : rows)
    if (row.setting == setting && row.region > 0 && row.rays == rows.front().rays && row.drive == rows.front().drive)
      out.push_back(&row);
  return out;
}

double entry_hits(const EntryGroup& region) { return static_cast<double>(region.hits); }
double entry_reads(const EntryGroup& region) { return region.read_cycles; }
double entry_writes(const EntryGroup& region) { return region.write_cycles; }
double region_lookups(const CacheRow& row) { return row.counts.lookups; }
double access_ns(const CacheRow& row) { return write_ns(row) + read_ns(row); }

namespace {

constexpr double clear_correlation = 0.5;

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

Judge<CacheRow> across_entries(std::vector<std::string> settings, EntryValue value, EntryValue with) {
  const auto pairs = [=](const CacheRows& rows, const std::string& setting) {
    RegionPairs out;
    const CacheRow* row = find_cached(rows, setting, rows.front().rays, rows.front().drive);
    if (!row) return out;
    for (const EntryGroup& region : row->entries.by_region) {
      if (std::isnan(value(region)) || std::isnan(with(region))) continue;
      out.a.push_back(value(region));
      out.b.push_back(with(region));
    }
    return out;
  };
  return correlated(std::move(settings), pairs, false);
}

}  // namespace wavetracer::study
