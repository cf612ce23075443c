// What the entries of a ray cache's table (output.cache_entries) say of a setting: by their depth in the trees of
// buckets, by region, and along the table.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>
#include "wavetracer/cache_entries.hpp"

namespace wavetracer::study {

// Entries that have something in common. Cycles are means of the middle nine tenths; NaN where no entry has answered,
// or there is no clock.
struct EntryGroup {
  uint32_t number = 0;  // a depth in the trees, from 1, or a region, from 0
  uint64_t entries = 0, hits = 0;
  double read_cycles = 0, write_cycles = 0;
};

// Entries of a run of slots.
struct SlotRun {
  uint32_t first_slot = 0;
  uint64_t entries = 0;
  double hits = 0;  // of an entry on average
};

struct EntrySummary {
  std::vector<EntryGroup> by_depth, by_region;  // ascending; entries that no search finds are left out of by_depth
  std::vector<SlotRun> runs;                    // of entries that hold a segment, along the table
  // The variance of the entries' hits over their mean: 1 if every entry is as likely to be asked (Poisson), less where
  // hits are still more even. NaN without hits.
  double dispersion = 0;
  // The variance of the runs' means over what it would be if entries answered as often wherever they are: about 1
  // then, larger where busy entries lie together, 0 where all entries are alike. NaN for fewer than two runs.
  double clustering = 0;
};

constexpr uint32_t slot_runs = 50;  // of about equal numbers of entries

EntrySummary summary_of(const CacheEntryRows& rows);

// Do entries in the buckets themselves, of depth 1, take more cycles than those below? None where a kind is missing.
std::optional<bool> reads_longer_in_buckets(const EntrySummary& entries);
std::optional<bool> writes_longer_in_buckets(const EntrySummary& entries);
// Hits are as even as chance makes them: dispersion is 1.5 at most.
std::optional<bool> are_even(const EntrySummary& entries);
// No busy entries lie together: clustering is 2 at most.
std::optional<bool> is_without_clusters(const EntrySummary& entries);

}  // namespace wavetracer::study
