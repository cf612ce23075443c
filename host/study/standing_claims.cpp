// SPDX-License-Identifier: Apache-2.0
// The claims of figures 6.2 to 6.9, each with its predicate and the numbers of rays that it is about.
// Times of operations are nanoseconds of a segment.
#include "study/standing_claims.hpp"
#include "study/lookup_parts.hpp"
#include "study/table_regions.hpp"

namespace wavetracer::study {
namespace {

Names counted_names(Names names) {
  for (std::string& name : names) name = counted_name(name);
  return names;
}
Names printed_names(Names names) {
  for (std::string& name : names) name = "printed " + name;
  return names;
}

constexpr const char* short_calls = "calls of the buffer take next to nothing: less than a tenth of a write";
constexpr const char* no_time_of_a_ray = "rays are traced in packets and groups, so that no ray has a time of its own";
// Answers whether a is less than b; the value is b over a.
Answered shorter(const Measured& a, const Measured& b) {
  return {less(a, b), a.value > 0 ? b.value / a.value : undefined};
}
Answered writes_longer_than_reads(const CacheRow& row) {
  return shorter(measured_read_ns(row), measured_write_ns(row));
}
Answered writes_as_three_reads(const CacheRow& row) {
  const Measured reads = quotient(measured_write_ns(row), measured_read_ns(row));
  return {between(reads, 2.5, 3.5), reads.value};
}
Judge<CacheRow> traces_longer_than(const Names& settings, Measured (*operation)(const CacheRow&),
                                   const std::string& name, double times = 1) {
  return of_each(
      settings,
      [=](const CacheRow& row) -> Answered {
        return {less(times * operation(row), measured_trace_ns(row)), trace_ns(row) / operation(row).value};
      },
      ratio_form("tracing", name));
}

// Judges the chained tables that keep their entries.
Judge<CacheRow> of_entries(Answered (*holds)(const EntrySummary&),
                           const ValueForm& form = ratio_form("buckets", "other nodes")) {
  return of_each(
      counted_names(all_chained), [holds](const CacheRow& row) { return holds(row.entries); }, form);
}
Answered longer_in_buckets(const Levels& levels) { return shorter(levels.below, levels.bucket); }
Answered are_even(const EntrySummary& entries) {
  return {below(measured_dispersion(entries), 1.5), entries.dispersion};
}
Answered is_without_clusters(const EntrySummary& entries) {
  return {below(measured_clustering(entries), 2), entries.clustering};
}
// A count of entries out of all is exact.
Answered some(uint64_t count, const CacheRow& row) {
  if (row.cache.entries == 0) return {};
  return {count > 0 ? Answer::yes : Answer::no, static_cast<double>(count) / static_cast<double>(row.cache.entries)};
}
Answered some_unused(const CacheRow& row) { return some(row.cache.entries - entries_used(row), row); }
Answered some_never_answer(const CacheRow& row) {
  return row.cache.entries_by_hits.empty() ? Answered{} : some(row.cache.entries_by_hits.front(), row);
}

// Returns the claims of figures 6.3 and 6.7 about tracing a segment against looking it up.
Claims<CacheRow> trace_claims(const Names& settings) {
  return {{"tracing takes longer than a read", traces_longer_than(settings, measured_read_ns, "a read")},
          {"tracing takes longer than ten reads", traces_longer_than(settings, measured_read_ns, "a read", 10)},
          {"tracing takes longer than a write", traces_longer_than(settings, measured_write_ns, "a write")}};
}

Claims<CacheRow> joined(Claims<CacheRow> claims, const Claims<CacheRow>& more) {
  claims.insert(claims.end(), more.begin(), more.end());
  return claims;
}

// Returns the claims of figure 6.5, about these tables.
Claims<CacheRow> window_claims_of(const Names& tables, const std::string& prefix) {
  return {{prefix + "no gain below 2,560,000 rays", where(saves_not(tables)), up_to(2559999)},
          {prefix + "a gain from 2,560,000 to 10,240,000 rays", where(saves(tables)), Range{2560000, 10240000}},
          {prefix + "no gain beyond 10,240,000 rays", where(saves_not(tables)), beyond(10240000)}};
}
}  // namespace

Claims<CacheRow> write_claims() {
  return {{"writes take longer than reads",
           of_each(all_chained, writes_longer_than_reads, ratio_form("a write", "a read"))},
          {short_calls, buffer_calls_are_short(all_chained)},
          {"writes take longer in buckets than in other nodes",
           of_entries([](const EntrySummary& entries) { return longer_in_buckets(write_levels(entries)); })},
          {"reads take longer in buckets than in other nodes",
           of_entries([](const EntrySummary& entries) { return longer_in_buckets(read_levels(entries)); })}};
}

Claims<CacheRow> bucket_claims() {
  return joined(trace_claims(all_chained),
                {{"tracing takes longer for buckets than for other nodes", not_judged(no_time_of_a_ray)}});
}

Claims<CacheRow> hit_claims() {
  const Names counted = counted_names(all_chained);
  return {{"hits are spread over the entries at least as evenly as by chance",
           of_entries(are_even, {"variance over mean: ", [](double value) { return plain(value); }, ""})},
          {"there are no clusters of busy entries",
           of_entries(is_without_clusters, {"clustering: ", [](double value) { return plain(value); }, ""})},
          {"some entries are left unused", of_each(counted, some_unused, share_form())},
          {"some entries never answer", of_each(counted, some_never_answer, share_form())}};
}

Claims<CacheRow> window_claims() {
  return joined(window_claims_of(chained_tables, ""),
                repeated(window_claims_of(printed_names(chained_tables), "as printed: ")));
}

Claims<CacheRow> lock_claims() {
  const Names counted = counted_names(all_mutexes);
  return {{"writes take longer than reads",
           of_each(all_mutexes, writes_longer_than_reads, ratio_form("a write", "a read"))},
          {"writes take three times as long as reads",
           of_each(all_mutexes, writes_as_three_reads, ratio_form("a write", "a read"))},
          {short_calls, buffer_calls_are_short(all_mutexes)},
          {"busier regions take longer to write", across_entries(counted, entry_hits, entry_writes)},
          {"busier regions take longer to read", across_entries(counted, entry_hits, entry_reads)},
          {"writes and reads have their peaks in the same regions", across_entries(counted, entry_reads, entry_writes)},
          {"writes take less than in the chained table, with the mixed hash",
           is_less(measured_write_ns, "mutex mixed", "chained mixed")},
          {"reads take less than in the chained table, with the mixed hash",
           is_less(measured_read_ns, "mutex mixed", "chained mixed")}};
}

Claims<CacheRow> region_claims() {
  return joined(trace_claims(all_mutexes),
                {{"regions that take longer to write and read are faster to trace",
                  across_regions(all_mutexes, access_ns, trace_ns, true)},
                 {"busier regions are faster to trace", across_regions(all_mutexes, region_lookups, trace_ns, true)}});
}

Claims<CacheRow> open_claims() {
  const Range many = beyond(50000);
  return {{"the time of no cache, within 10%, up to 50,000 rays", where(all_take_the_time_of_none(readers, 10)),
           up_to(50000)},
          {"a gain beyond 50,000 rays", where(saves(readers)), many},
          {"the mixed hash is the fastest beyond 50,000 rays", where(fastest_is("readers mixed", readers)), many},
          {"Morton codes are the slowest of the three beyond 50,000 rays", where(slowest_is("readers Morton", readers)),
           many},
          {"a gain from fewer rays on than with the chained table, with the mixed hash",
           gains_earlier("readers mixed", "chained mixed")},
          {"as printed: a gain beyond 50,000 rays", where(saves(printed_names(readers))), many, Origin::repetition}};
}

Claims<CacheRow> ordered_claims() {
  return {{"a gain beyond 16,000 rays", where(saves(mutexes)), beyond(16000)},
          {"most seconds are saved at 2,048,000 rays", saves_most_at(mutexes, 2048000)},
          {"as printed: a gain beyond 16,000 rays", where(saves(printed_names(mutexes))), beyond(16000),
           Origin::repetition}};
}

}  // namespace wavetracer::study
