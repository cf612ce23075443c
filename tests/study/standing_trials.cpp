// SPDX-License-Identifier: Apache-2.0
// Trials of the claims of figures 6.2 to 6.9.
// Names of settings are those of the studies.
#include "study/claim_trials.hpp"

namespace claim_trials {
namespace {

using Trials = std::vector<Trial<CacheRow>>;

// Nanoseconds of a segment: 80 segments are written, 100 read. Those of the chained table, the mixed one of figure 6.6,
// are multiplied.
CacheChange operations_of(double write, double read, double gather, double trace, double chained = 1) {
  return [=](CacheRow& row) {
    const double times = row.setting.find("chained") != std::string::npos ? chained : 1;
    row.cold.store_s = times * 80e-9 * write;
    row.cold.gather_s = 80e-9 * gather;
    row.cold.trace_s = 80e-9 * trace;
    row.warm.lookup_s = times * 100e-9 * read;
  };
}

Trial<CacheRow> operation_trial(const std::string& figure, const std::string& words, const CacheChange& yes,
                                const CacheChange& no) {
  return trial(figure, words, same, same, yes, no);
}

CacheChange entries_of(const std::function<void(EntrySummary&)>& change) {
  return [=](CacheRow& row) {
    row.entries = {.by_depth = {{1, 700, 1500, 200, 200, 1, 1}, {2, 300, 500, 200, 200, 1, 1}},
                   .by_region = {},
                   .runs = {{0, 500, 2.5}, {500, 500, 1.5}},
                   .dispersion = 0.8,
                   .clustering = 1};
    for (uint32_t run = 2; run < slot_runs; ++run) row.entries.runs.push_back({run * 500, 500, 2});
    change(row.entries);
  };
}

CacheChange in_buckets(double EntryGroup::*cycles, double bucket) {
  return entries_of([=](EntrySummary& entries) { entries.by_depth[0].*cycles = bucket; });
}
CacheChange with_number(double EntrySummary::*number, double value) {
  return entries_of([=](EntrySummary& entries) { entries.*number = value; });
}
CacheChange hits_of_entries(std::vector<uint64_t> entries_by_hits) {
  return [=](CacheRow& row) { row.cache.entries_by_hits = entries_by_hits; };
}

// Claims about exact counts: the third rows are those of settings that counted nothing.
Trial<CacheRow> exact_trial(const std::string& figure, const std::string& words, const CacheChange& yes,
                            const CacheChange& no) {
  const auto rows = [=](const CacheChange& change) { return [=] { return rows_of(figure, same, change); }; };
  return {figure, words, rows(yes), rows(no), rows([](CacheRow& row) { row.cache = {}; }), Third::not_measured};
}

// Rows in which a write takes 30 ns, gathering 1 ns, and a look-up of an empty table this long besides its hash.
CacheRows call_rows(const std::string& figure, double call_ns) {
  return with_empty_lookups(rows_of(figure, same, operations_of(30, 20, 1, 0)), {call_ns, 5, 2});
}

Trial<CacheRow> call_trial(const std::string& figure) {
  return {figure, "calls of the buffer take next to nothing: less than a tenth of a write",
          [=] { return call_rows(figure, 1); }, [=] { return call_rows(figure, 9); },
          [=] {
            CacheRows rows = call_rows(figure, 1);
            for (CacheRow& row : rows) make_noisy(row);
            return rows;
          }};
}

void add_operations(Trials& out) {
  for (const std::string figure : {"figure-6.2", "figure-6.6"}) {
    out.push_back(operation_trial(figure, "writes take longer than reads", operations_of(30, 20, 1, 0),
                                  operations_of(20, 30, 1, 0)));
    out.push_back(call_trial(figure));
  }
  for (const std::string figure : {"figure-6.3", "figure-6.7"}) {
    out.push_back(operation_trial(figure, "tracing takes longer than a read", operations_of(30, 20, 1, 30),
                                  operations_of(30, 20, 1, 10)));
    out.push_back(operation_trial(figure, "tracing takes longer than ten reads", operations_of(30, 20, 1, 300),
                                  operations_of(30, 20, 1, 100)));
    out.push_back(operation_trial(figure, "tracing takes longer than a write", operations_of(30, 20, 1, 60),
                                  operations_of(30, 20, 1, 10)));
  }
  out.push_back(operation_trial("figure-6.6", "writes take three times as long as reads", operations_of(60, 20, 1, 0),
                                operations_of(20, 20, 1, 0)));
  out.push_back(operation_trial("figure-6.6", "writes take less than in the chained table, with the mixed hash",
                                operations_of(30, 20, 1, 0, 2), operations_of(30, 20, 1, 0, 0.5)));
  out.push_back(operation_trial("figure-6.6", "reads take less than in the chained table, with the mixed hash",
                                operations_of(30, 20, 1, 0, 2), operations_of(30, 20, 1, 0, 0.5)));
}

void add_entries(Trials& out) {
  const auto one = [&](const char* figure, const char* words, const CacheChange& yes, const CacheChange& no) {
    out.push_back(trial(figure, words, same, same, yes, no));
  };
  // Numbers at the limit, within the noise of so many entries or runs.
  const auto third_of_last = [&](const CacheChange& change) {
    out.back().third = [figure = out.back().figure, change] { return rows_of(figure, same, change); };
  };
  one("figure-6.2", "writes take longer in buckets than in other nodes", in_buckets(&EntryGroup::write_cycles, 300),
      in_buckets(&EntryGroup::write_cycles, 100));
  one("figure-6.2", "reads take longer in buckets than in other nodes", in_buckets(&EntryGroup::read_cycles, 300),
      in_buckets(&EntryGroup::read_cycles, 100));
  one("figure-6.4", "hits are spread over the entries at least as evenly as by chance",
      with_number(&EntrySummary::dispersion, 0.8), with_number(&EntrySummary::dispersion, 3));
  third_of_last(with_number(&EntrySummary::dispersion, 1.5));
  one("figure-6.4", "there are no clusters of busy entries", with_number(&EntrySummary::clustering, 1),
      with_number(&EntrySummary::clustering, 6));
  third_of_last(with_number(&EntrySummary::clustering, 2));
  out.push_back(exact_trial("figure-6.4", "some entries are left unused", hits_of_entries({100, 200}),
                            hits_of_entries({0, 50000})));
  out.push_back(
      exact_trial("figure-6.4", "some entries never answer", hits_of_entries({100, 200}), hits_of_entries({0, 50000})));
}

// Rows with eight regions, in which a number goes with another one as `factor` says; three regions decide nothing.
CacheRows region_rows(const std::string& figure, uint32_t count, const std::function<void(CacheRow&, double)>& set) {
  CacheRows rows = rows_of(figure, same);
  CacheRows out = rows;
  for (CacheRow row : rows)
    for (uint32_t region = 1; region <= count; ++region) {
      row.region = region;
      set(row, region);
      out.push_back(row);
    }
  return out;
}

Trial<CacheRow> region_trial(const std::string& words, const std::function<void(CacheRow&, double)>& yes,
                             const std::function<void(CacheRow&, double)>& no) {
  const std::string figure = "figure-6.7";
  return {figure, words, [=] { return region_rows(figure, 8, yes); }, [=] { return region_rows(figure, 8, no); },
          [=] { return region_rows(figure, 3, yes); }};
}

// Hits grow from region to region, as do both kinds of cycles but the one that is given: it falls if it does not go
// along.
CacheChange region_entries(uint32_t count, double EntryGroup::*cycles, bool along) {
  return [=](CacheRow& row) {
    row.entries.by_region.clear();
    for (uint32_t region = 0; region < count; ++region) {
      row.entries.by_region.push_back({region, 100, 100 * (region + 1), 10.0 + region, 10.0 + region});
      row.entries.by_region.back().*cycles = along ? 10 + region : 50 - region;
    }
  };
}

void add_regions(Trials& out) {
  // Writes, reads and look-ups grow from region to region; tracing falls, or grows.
  const auto set = [](CacheRow& row, double region, double traced) {
    row.counts = row.cold_counts = {100 * region, 100 * region, 0};
    row.cold.store_s = row.warm.lookup_s = 1e-9 * region * row.counts.lookups;
    row.cold.trace_s = 1e-9 * traced * row.counts.lookups;
  };
  const auto falls = [=](CacheRow& row, double region) { set(row, region, 20 - region); };
  const auto grows = [=](CacheRow& row, double region) { set(row, region, 20 + region); };
  out.push_back(region_trial("regions that take longer to write and read are faster to trace", falls, grows));
  out.push_back(region_trial("busier regions are faster to trace", falls, grows));
  for (const auto& [words, cycles] :
       {std::pair{"busier regions take longer to write", &EntryGroup::write_cycles},
        {"busier regions take longer to read", &EntryGroup::read_cycles},
        {"writes and reads have their peaks in the same regions", &EntryGroup::read_cycles}}) {
    const auto rows = [cycles](uint32_t count, bool along) {
      return [=] { return rows_of("figure-6.6", same, region_entries(count, cycles, along)); };
    };
    out.push_back({"figure-6.6", words, rows(8, true), rows(8, false), rows(4, true)});
    // Four regions that hardly go along.
    out.back().third = [cycles] {
      return rows_of("figure-6.6", same, [cycles](CacheRow& row) {
        region_entries(4, cycles, true)(row);
        row.entries.by_region[3].*cycles = 9;
      });
    };
  }
}

// Seconds of one setting within a range of rays; a second elsewhere.
CacheCost in_range(const std::string& setting, const Range& range, double seconds) {
  return [=](const std::string& one, uint64_t rays) {
    return std::pair{one == setting && range.contains(rays) ? seconds : 1.0, 0.0};
  };
}
// All three tables take this long.
CacheCost all_take(const std::string& tables, double seconds) {
  return [=](const std::string& one, uint64_t) { return std::pair{one.starts_with(tables) ? seconds : 1.0, 0.0}; };
}

// The open and the chained table with the mixed hash gain beyond these numbers of rays, and lose before.
CacheCost gains_beyond(uint64_t open_rays, uint64_t chained_rays) {
  return [=](const std::string& one, uint64_t rays) {
    if (one == "readers mixed") return std::pair{rays > open_rays ? 0.8 : 1.2, 0.0};
    return std::pair{one == "chained mixed" ? (rays > chained_rays ? 0.8 : 1.2) : 1.0, 0.0};
  };
}

void add_times(Trials& out) {
  for (const std::string kind : {"", "printed "}) {
    const std::string as = kind.empty() ? "" : "as printed: ", chained = kind + "chained";
    out.push_back(
        trial("figure-6.5", as + "no gain below 2,560,000 rays", all_take(chained, 1.2), all_take(chained, 0.8)));
    out.push_back(trial("figure-6.5", as + "no gain beyond 10,240,000 rays", all_take(chained, 1.2),
                        in_range(chained + " Morton", beyond(10240000), 0.8)));
    out.push_back(trial("figure-6.5", as + "a gain from 2,560,000 to 10,240,000 rays",
                        in_range(chained + " Morton", {2560000, 10240000}, 0.8), all_take(chained, 1.2)));
    out.push_back(trial("figure-6.8", as + "a gain beyond 50,000 rays",
                        in_range(kind + "readers mixed", beyond(50000), 0.8),
                        [kind](const std::string& one, uint64_t rays) {
                          return std::pair{one.starts_with(kind + "readers") ? (rays > 50000 ? 1.2 : 0.5) : 1.0, 0.0};
                        }));
    out.push_back(trial("figure-6.9", as + "a gain beyond 16,000 rays",
                        in_range(kind + "mutex uniform", beyond(16000), 0.8), all_take(kind + "mutex", 1.2)));
  }
  out.push_back(trial("figure-6.8", "the time of no cache, within 10%, up to 50,000 rays", all_take("readers", 1.05),
                      in_range("readers Morton", up_to(50000), 1.2)));
  out.push_back(trial("figure-6.8", "the mixed hash is the fastest beyond 50,000 rays",
                      in_range("readers mixed", beyond(50000), 0.9), in_range("readers uniform", beyond(50000), 0.9)));
  out.push_back(trial("figure-6.8", "Morton codes are the slowest of the three beyond 50,000 rays",
                      in_range("readers Morton", beyond(50000), 1.2), in_range("readers mixed", beyond(50000), 1.2)));
  out.push_back(trial("figure-6.8", "a gain from fewer rays on than with the chained table, with the mixed hash",
                      gains_beyond(2000, 8000), gains_beyond(8000, 2000)));
  out.push_back(trial("figure-6.9", "most seconds are saved at 2,048,000 rays",
                      in_range("mutex mixed", at_rays(2048000), 0.8), in_range("mutex mixed", at_rays(1000), 0.8)));
}

}  // namespace

std::vector<Trial<CacheRow>> standing_trials() {
  Trials out;
  add_operations(out);
  add_entries(out);
  add_regions(out);
  add_times(out);
  return out;
}

}  // namespace claim_trials
