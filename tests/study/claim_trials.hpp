// SPDX-License-Identifier: Apache-2.0
// Trials of claims: for each claim of an experiment, rows for which it holds, rows for which it does not, and rows that
// leave it undecided.
#pragma once
#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>
#include "study/cache_verdicts.hpp"
#include "study/made_order_rows.hpp"

namespace claim_trials {

using namespace wavetracer::study;

enum class Third {
  undecided,    // the third rows are within the noise
  not_measured  // the claim is about exact numbers: the third rows do not have them
};

template <class Row>
struct Trial {
  std::string figure, words;
  std::function<std::vector<Row>()> yes, no, third;
  Third is = Third::undecided;
};

using CacheChange = std::function<void(CacheRow&)>;

// Nanoseconds of a look-up of an empty table: each hash, and the rest.
struct EmptyLookup {
  double rest, uniform, morton;
};

// Adds rows of depth 1 for all settings that end in the name of a hash. Those whole rows have 100 look-ups.
inline CacheRows with_empty_lookups(CacheRows rows, const EmptyLookup& takes) {
  for (CacheRow row : CacheRows(rows)) {
    if (row.region > 0) continue;
    double ns = takes.rest;
    if (row.setting.ends_with(" uniform") || row.setting.ends_with(" mixed")) ns += takes.uniform;
    if (row.setting.ends_with(" Morton") || row.setting.ends_with(" mixed")) ns += takes.morton;
    row.depth = 1;
    row.cold.lookup_s = 100e-9 * ns;
    rows.push_back(row);
  }
  return rows;
}

// Returns the rows of a figure's study at all its numbers of rays.
inline CacheRows rows_of(const std::string& figure, const CacheCost& cost, const CacheChange& change = {}) {
  const CacheStudy& study = *find_experiment(figure).study();
  CacheRows rows = made_measurement(study, study.rays, cost).rows;
  if (change)
    for (CacheRow& row : rows) change(row);
  return rows;
}

// Makes every number of a row three times as noisy as it is large.
inline void make_noisy(CacheRow& row) {
  const auto noise_of = [](const CacheTimes& times) {
    return CacheTimes{3 * times.loop_s,  3 * times.lookup_s, 3 * times.gather_s, 3 * times.store_s,
                      3 * times.group_s, 3 * times.purge_s,  3 * times.trace_s};
  };
  row.warm_error = noise_of(row.warm);
  row.cold_error = noise_of(row.cold);
  row.l2_error_m = 3 * row.error.l2_m;
  row.error.reference_paths = 1;
  for (EntryGroup& group : row.entries.by_depth) {
    group.read_error = 3 * group.read_cycles;
    group.write_error = 3 * group.write_cycles;
  }
  for (SlotRun& run : row.entries.runs) run.entries = 1;
}

inline void keep(CacheRow&) {}

// The third rows are those that hold, with noise.
inline Trial<CacheRow> trial(const std::string& figure, const std::string& words, const CacheCost& yes,
                             const CacheCost& no, const CacheChange& yes_change = keep,
                             const CacheChange& no_change = keep) {
  return {figure, words, [=] { return rows_of(figure, yes, yes_change); },
          [=] { return rows_of(figure, no, no_change); },
          [=] {
            return rows_of(figure, yes, [yes_change](CacheRow& row) {
              yes_change(row);
              make_noisy(row);
            });
          }};
}

using Numbers = std::vector<std::pair<std::string, double>>;

// Seconds, or metres, of settings by name; all others have a second and no error.
inline CacheCost taking(const Numbers& seconds) {
  return [seconds](const std::string& setting, uint64_t) {
    for (const auto& [name, s] : seconds)
      if (name == setting) return std::pair{s, 0.0};
    return std::pair{1.0, 0.0};
  };
}
inline CacheCost off(const Numbers& metres) {
  return [metres](const std::string& setting, uint64_t) {
    for (const auto& [name, m] : metres)
      if (name == setting) return std::pair{1.0, m};
    return std::pair{1.0, 0.0};
  };
}

// Returns the trials of each list, in one.
std::vector<Trial<CacheRow>> standing_trials();
std::vector<Trial<CacheRow>> traffic_trials();
std::vector<Trial<CacheRow>> innerframe_trials();
std::vector<Trial<OrderRow>> order_trials();
std::vector<Trial<FramePair>> frame_trials();

}  // namespace claim_trials
