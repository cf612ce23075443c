// SPDX-License-Identifier: Apache-2.0
// Groups rows of one table.
// Means of cycles leave the longest and shortest out, as a few operations are interrupted for thousands of times their
// usual duration. Medians would not work: clocks tick in steps of some twenty cycles.
#include "study/entry_summary.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include "study/statistics.hpp"

namespace wavetracer::study {
namespace {

// The mean of the middle nine tenths of the measured cycles.
struct Cycles {
  std::vector<double> values;
  void add(uint32_t cycles) {
    if (cycles > 0) values.push_back(cycles);
  }
  Measured middle() {
    std::ranges::sort(values);
    const auto out = static_cast<std::ptrdiff_t>(values.size() / 20);
    RunningMean mean;
    for (auto at = values.begin() + out; at != values.end() - out; ++at) mean.add(*at);
    return {mean.mean(), mean.standard_error()};
  }
};

struct Gathered {
  EntryGroup group;
  Cycles read, write;
};

std::vector<EntryGroup> grouped_by(const CacheEntryRows& rows, const std::vector<uint32_t>& numbers,
                                   uint32_t first_number) {
  std::map<uint32_t, Gathered> found;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (numbers[i] < first_number) continue;
    Gathered& one = found[numbers[i]];
    ++one.group.entries;
    one.group.hits += rows.hits[i];
    one.read.add(rows.read_cycles[i]);
    one.write.add(rows.write_cycles[i]);
  }
  std::vector<EntryGroup> out;
  for (auto& [number, one] : found) {
    one.group.number = number;
    const Measured read = one.read.middle(), write = one.write.middle();
    one.group.read_cycles = read.value;
    one.group.read_error = read.error;
    one.group.write_cycles = write.value;
    one.group.write_error = write.error;
    out.push_back(one.group);
  }
  return out;
}

double variance(const RunningMean& mean) {
  return std::pow(mean.standard_error(), 2) * static_cast<double>(mean.count());
}

// Deeper ones are weighted by their entries.
Levels levels_of(const EntrySummary& entries, double EntryGroup::*cycles, double EntryGroup::*error) {
  Levels out;
  double sum = 0, count = 0, noise = 0;
  for (const EntryGroup& group : entries.by_depth) {
    if (std::isnan(group.*cycles)) continue;
    if (group.number == 1) {
      out.bucket = {group.*cycles, group.*error};
    } else {
      const auto weight = static_cast<double>(group.entries);
      sum += weight * group.*cycles;
      // A group of one entry has no standard error.
      noise = std::hypot(noise, weight * (std::isnan(group.*error) ? group.*cycles : group.*error));
      count += weight;
    }
  }
  if (count > 0) out.below = {sum / count, noise / count};
  return out;
}

// Returns a variance over the one expected, whose relative standard error for n values is about the root of 2 / n.
Measured of_sample(double ratio, double n) { return {ratio, ratio * std::sqrt(2 / std::max(n - 1, 1.0))}; }

}  // namespace

EntrySummary summary_of(const CacheEntryRows& rows) {
  EntrySummary out;
  const size_t samples = std::min<size_t>(rows.size(), entry_samples);
  for (size_t sample = 0; sample < samples; ++sample) {
    const size_t i = rows.size() * sample / samples;
    out.samples.push_back(
        {rows.slot[i], rows.region[i], rows.depth[i], rows.hits[i], rows.read_cycles[i], rows.write_cycles[i]});
  }
  out.by_depth = grouped_by(rows, rows.depth, 1);
  out.by_region = grouped_by(rows, rows.region, 0);
  RunningMean all, means;
  double run_entries = 0;
  for (uint32_t run = 0; run < slot_runs; ++run) {
    const size_t begin = rows.size() * run / slot_runs, end = rows.size() * (run + 1) / slot_runs;
    if (begin == end) continue;
    RunningMean hits;
    for (size_t i = begin; i < end; ++i) {
      hits.add(rows.hits[i]);
      all.add(rows.hits[i]);
    }
    out.runs.push_back({rows.slot[begin], end - begin, hits.mean()});
    means.add(hits.mean());
    run_entries += static_cast<double>(end - begin);
  }
  run_entries /= static_cast<double>(std::max<size_t>(out.runs.size(), 1));
  out.dispersion = variance(all) / all.mean();
  const double by_chance = variance(all) / run_entries;
  // 0 if all are alike, NaN if there are too few.
  out.clustering = by_chance > 0 ? variance(means) / by_chance : by_chance;
  return out;
}

Levels read_levels(const EntrySummary& entries) {
  return levels_of(entries, &EntryGroup::read_cycles, &EntryGroup::read_error);
}

Levels write_levels(const EntrySummary& entries) {
  return levels_of(entries, &EntryGroup::write_cycles, &EntryGroup::write_error);
}

Measured measured_dispersion(const EntrySummary& entries) {
  double count = 0;
  for (const SlotRun& run : entries.runs) count += static_cast<double>(run.entries);
  return of_sample(entries.dispersion, count);
}

Measured measured_clustering(const EntrySummary& entries) {
  return of_sample(entries.clustering, static_cast<double>(entries.runs.size()));
}

}  // namespace wavetracer::study
