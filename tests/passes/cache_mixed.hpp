// SPDX-License-Identifier: Apache-2.0
// Mixed operations on a table of the ray cache, all at once, and the content of the table afterwards, compared with a
// model that runs in sequence: for tests and bench_cache. For every order of the operations, each count of
// MixedFaults is 0.
#pragma once
#include <algorithm>

#include "passes/cache_probe.hpp"

namespace wavetracer::test {

// SplitMix64, as mixed_operations draws its operations.
inline uint64_t split_mix(uint64_t i) {
  uint64_t x = i * 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

// The same operations in sequence: the number of puts, and their keys.
struct SequentialModel {
  uint64_t puts = 0;
  std::vector<bool> was_put;

  SequentialModel(uint64_t operations, uint32_t universe) : was_put(universe) {
    for (uint64_t i = 0; i < operations; ++i) {
      const uint64_t random = split_mix(i);
      if ((random >> 3 & 3) != 0) continue;
      const uint64_t most = (random & 7) == 0 ? std::min(universe, 64u) : universe;
      was_put[(random >> 32) * most >> 32] = true;
      ++puts;
    }
  }
};

// Counts states that no order of the operations can leave.
struct MixedFaults {
  size_t wrong_answers = 0;  // torn, of another key, or of a frame in which it was not written
  size_t never_put = 0;      // keys that are in the table although nobody put them
  size_t lost = 0;           // keys whose put returned a place where they are missing
  size_t miscounted = 0;     // mismatches of counters and contents
  size_t all() const { return wrong_answers + never_put + lost + miscounted; }
};

struct MixedReport {
  MixedFaults faults;
  uint64_t puts = 0, hits = 0, replaced = 0, dropped = 0;
  double seconds = 0;
};

// Uses keys of which `load` times the table's entries may be stored. Quantised keys are purged by precision: an entry
// of another frame is not valid, see probe_cache.cl.
inline MixedReport run_mixed(gpu::Context& context, const TableKind& kind, uint64_t operations, uint64_t entries,
                             double load) {
  CacheConfig config = kind.config(entries);
  config.purge = "precision";
  config.residual_value = 0.5;
  CacheProbe probe(context, config, 3);
  const auto universe = static_cast<uint32_t>(load * static_cast<double>(entries));
  const SequentialModel model(operations, universe);
  probe.mixed(0, universe);  // compiles
  const CacheProbe::Outcome outcome = probe.mixed(operations, universe);
  const wt_cache_counters counters = probe.counters();
  const uint32_t kept = counters.stored - counters.replaced;
  MixedFaults faults;
  const auto agree = [&](bool condition) { faults.miscounted += !condition; };
  agree(outcome.puts == model.puts);
  agree(uint64_t{outcome.puts} + outcome.finds == operations);
  agree(uint64_t{counters.stored} + counters.duplicates + counters.dropped == model.puts);
  agree(counters.exhausted <= counters.dropped);
  agree(counters.replaced <= counters.stored);

  const std::vector<uint32_t> found = probe.find_keys(universe);
  const std::vector<wt_cache_entry> table = probe.table.entries.read();
  faults.wrong_answers =
      outcome.wrong + static_cast<size_t>(std::count(found.begin(), found.end(), CacheProbe::wrong_answer));
  size_t count = 0;
  for (uint32_t key = 0; key < universe; ++key) {
    count += found[key] != WT_NONE;
    faults.never_put += found[key] != WT_NONE && !model.was_put[key];
    if (outcome.slots[key] == WT_NONE) continue;
    // In an open table others may have taken the slot since, but it never becomes empty.
    faults.lost += kind.kind == "open" ? table[outcome.slots[key]].version == 0 : found[key] != outcome.slots[key];
  }
  if (kind.kind != "open") agree(count == kept);  // more are kept than found if a key is there twice
  if (kind.kind != "chained") {                   // its pool also has entries that no tree took
    std::vector<bool> there(universe);
    size_t written = 0, keys = 0;
    for (const wt_cache_entry& entry : table) {
      if (entry.version == 0) continue;
      ++written;
      if (entry.next >= universe || !model.was_put[entry.next]) {
        ++faults.never_put;
      } else if (!there[entry.next]) {
        there[entry.next] = true;
        ++keys;
      }
    }
    agree(written == kept);
    agree(keys == kept);
  }
  return {faults, outcome.puts, outcome.hits, counters.replaced, counters.dropped, outcome.seconds};
}

}  // namespace wavetracer::test
