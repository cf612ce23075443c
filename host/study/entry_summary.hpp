// SPDX-License-Identifier: Apache-2.0
// Statistics of the entries of a ray cache's table (output.cache_entries) for a setting: by their depth in the trees of
// buckets, by region, and along the table.
#pragma once
#include <cstdint>
#include <vector>
#include "study/measured.hpp"
#include "wavetracer/cache_entries.hpp"

namespace wavetracer::study {

// Entries that have something in common. Cycles are means of the middle nine tenths; NaN if no entry has answered, or
// there is no clock.
struct EntryGroup {
  uint32_t number = 0;  // a depth in the trees, from 1, or a region, from 0
  uint64_t entries = 0, hits = 0;
  double read_cycles = 0, write_cycles = 0;
  double read_error = undefined, write_error = undefined;  // standard errors of these means
};

// Entries of a run of slots.
struct SlotRun {
  uint32_t first_slot = 0;
  uint64_t entries = 0;
  double hits = 0;  // average over the entries
};

// One entry. Cycles are 0 where it has not answered, or without a clock.
struct EntrySample {
  uint32_t slot = 0, region = 0, depth = 0, hits = 0, read_cycles = 0, write_cycles = 0;
};

struct EntrySummary {
  std::vector<EntryGroup> by_depth, by_region;  // ascending; entries that no search finds are left out of by_depth
  std::vector<SlotRun> runs;                    // runs of entries that hold a segment, along the table
  std::vector<EntrySample> samples = {};        // entries at equal distances in the list of all, along the table
  // The variance of the entries' hits over their mean: 1 if every entry is equally likely to be asked (Poisson), less
  // if hits are more even than that. NaN without hits.
  double dispersion = 0;
  // The variance of the runs' means over the variance expected if the place did not matter: about 1 then, larger if
  // busy entries lie together, 0 if all entries are alike. NaN for fewer than two runs.
  double clustering = 0;
};

constexpr uint32_t slot_runs = 50;       // runs have about equal numbers of entries
constexpr uint32_t entry_samples = 400;  // fewer if the table has fewer entries

EntrySummary summary_of(const CacheEntryRows& rows);

// An average of entries in the buckets themselves, of depth 1, and of deeper ones. NaN if one kind is missing.
struct Levels {
  Measured bucket, below;
};
Levels read_levels(const EntrySummary& entries);
Levels write_levels(const EntrySummary& entries);

// Return dispersion and clustering with the noise that a sample of so many entries, or runs, has.
Measured measured_dispersion(const EntrySummary& entries);
Measured measured_clustering(const EntrySummary& entries);

}  // namespace wavetracer::study
