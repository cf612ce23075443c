// SPDX-License-Identifier: Apache-2.0
// Tests the parts of a look-up, and figures along the buffer, on rows whose times are chosen.
#include "study/buffer_views.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include "contains.hpp"
#include "study/claim_trials.hpp"
#include "study/lookup_parts.hpp"
#include "study/run.hpp"
#include "study/squeezed.hpp"

using namespace claim_trials;

namespace {

// A write takes 30 ns, a read 20, gathering 4, tracing 50.
CacheRows rows_of_figure(const std::string& figure, const EmptyLookup& takes) {
  return with_empty_lookups(rows_of(figure, cache_verdicts::same,
                                    [](CacheRow& row) {
                                      row.cold.store_s = 80e-9 * 30;
                                      row.cold.gather_s = 80e-9 * 4;
                                      row.cold.trace_s = 80e-9 * 50;
                                      row.warm.lookup_s = 100e-9 * 20;
                                    }),
                            takes);
}

CacheMeasurement measurement_of(const CacheRows& rows) {
  CacheMeasurement out;
  out.device.name = "the device";
  out.rows = rows;
  out.points = out.planned = 1;
  return out;
}

Findings figure_of(const std::string& name, const CacheRows& rows) {
  return show(find_experiment(name), measurement_of(rows), {});
}

}  // namespace

TEST_CASE("parts of a look-up: each hash and the rest, of both kinds of tables, and of tables as printed") {
  const CacheRows rows = rows_of_figure("figure-6.6", {3, 7, 2});
  const auto check = [&](const std::string& setting, double hash) {
    CAPTURE(setting);
    const LookupParts parts = lookup_parts(rows, setting);
    CHECK(parts.hash.value == doctest::Approx(hash));
    CHECK(parts.buffer_call.value == doctest::Approx(3));
  };
  for (const std::string printed : {"", "printed "})
    for (const std::string table : {"chained ", "mutex "}) {
      check(printed + table + "uniform", 7);
      check(printed + table + "Morton", 2);
      check(printed + table + "mixed", 9);
    }
  // The noise of a difference is that of its terms: a hundredth of 10, 5 and 12 ns at least.
  CHECK(lookup_parts(rows, "chained uniform").hash.error >= 0.01 * std::hypot(12, 5) / noise_factor);
}

TEST_CASE("parts of a look-up: tables without a hash of three, and look-ups that were not measured") {
  const CacheRows rows = rows_of_figure("figure-6.2", {3, 7, 2});
  CHECK(std::isnan(lookup_parts(rows, "no cache").hash.value));
  CHECK(std::isnan(lookup_parts(rows, "mutex mixed").buffer_call.value));
  CHECK(std::isnan(lookup_parts({}, "chained mixed").hash.value));
  CHECK(std::isnan(lookup_parts(rows_of("figure-6.2", cache_verdicts::same), "chained mixed").hash.value));
}

TEST_CASE("calls of the buffer: a tenth of a write, with and without the reading of the ray") {
  const auto outcome = [](double call_ns) {
    return outcome_of(buffer_calls_are_short({"chained mixed"})(rows_of_figure("figure-6.2", {call_ns, 1, 1})));
  };
  CHECK(outcome(2) == ClaimOutcome::reproduced);
  CHECK(outcome(5) == ClaimOutcome::undecided);  // 3 ns are a tenth, and a ray takes 4 at most
  CHECK(outcome(9) == ClaimOutcome::refuted);
}

TEST_CASE("along the buffer: entries have their share of the mean, other operations a line") {
  const Findings found = figure_of("figure-6.3", rows_of_figure("figure-6.3", {3, 7, 2}));
  const std::string table = found.figure.data.front().text;
  CHECK(
      table.starts_with("drive,setting,operation,slot,region,tree_depth,hits,cycles,ns\n"
                        "still,chained uniform,write,0,0,1,3,95,15\n"             // half of the mean of 190 cycles
                        "still,chained uniform,write,40,0,2,0,380,60\n"           // twice
                        "still,chained uniform,read,0,0,1,3,75,10\n"              // half of 150
                        "still,chained uniform,call of the buffer,0,0,0,0,0,3\n"  // the other entry never answered
                        "still,chained uniform,call of the buffer,40,0,0,0,0,3\n"
                        "still,chained uniform,hash,0,0,0,0,0,7\n"
                        "still,chained uniform,hash,40,0,0,0,0,7\n"
                        "still,chained uniform,trace,0,0,0,0,0,50\n"));
  CHECK(contains(table, "still,printed chained mixed,hash,40,0,0,0,0,9\n"));
  CHECK_FALSE(contains(table, "counted"));
  const std::string words = squeezed(words_text(found.words));
  CHECK(contains(words, "| setting | write | read | call of the buffer | hash | trace |"));
  CHECK(contains(words, "| chained uniform | 30.0 | 20.0 | 3.00 | 7.00 | 50.0 |"));
  for (const char* title : {"chained Morton", "printed chained uniform"})
    CHECK(contains(found.figure.commands, std::string("set title '") + title + "'"));
}

TEST_CASE("along the buffer: without tracing the numbers have the levels of trees, and noise is called noise") {
  const Findings found = figure_of("figure-6.2", rows_of_figure("figure-6.2", {-1, 7, 2}));
  CHECK_FALSE(contains(found.figure.data.front().text, ",trace,"));
  CHECK_FALSE(contains(found.figure.data.front().text, ",call of the buffer,"));
  const std::string words = squeezed(words_text(found.words));
  CHECK(contains(words, "| chained Morton | 30.0 | 20.0 | below the noise | 2.00 | 160 | 260 | 130 | 180 |"));
  CHECK(contains(words,
                 "| reads take longer in buckets than in other nodes | refuted | \"chained uniform counted\": no "
                 "(buckets over other nodes: 0.72); "));
}

TEST_CASE("along the buffer: a region has the times of its transmitter, and without a clock the mean alone") {
  CacheRows rows = rows_of_figure("figure-6.7", {3, 7, 2});
  for (CacheRow& row : rows)
    if (row.setting == "mutex mixed counted") {
      row.entries.by_region = {{0, 10, 20, 100, 200}, {1, 10, 20, 150, undefined}};
      row.entries.samples = {
          {5, 0, 1, 3, 100, 400}, {7, 0, 1, 3, 100, 200000}, {90, 1, 1, 3, 300, 0}, {99, 1, 1, 3, 150, 0}};
    }
  CacheRow region = *find_cached(rows, "mutex mixed", 50000);
  region.region = 2;
  region.transmitter = "mast 2";
  region.cold.store_s = 80e-9 * 12;
  region.cold.trace_s = 80e-9 * 33;
  rows.push_back(region);
  const Findings found = figure_of("figure-6.7", rows);
  const std::string table = found.figure.data.front().text;
  CHECK(contains(table, "still,mutex mixed,write,5,0,1,3,400,60\n"));  // of the whole frame
  CHECK(contains(table, "still,mutex mixed,write,90,1,0,0,0,12\nstill,mutex mixed,write,99,1,0,0,0,12\n"));
  CHECK(contains(table, "still,mutex mixed,read,90,1,1,3,300,40\n"));
  CHECK_FALSE(contains(table, "write,7,"));  // it was interrupted
  CHECK(contains(table, "still,mutex mixed,trace,99,1,0,0,0,33\n"));
  const std::string words = squeezed(words_text(found.words));
  CHECK(contains(words, "| mutex mixed | all | 100 | 75% | 30.0 | 20.0 | 3.00 | 9.00 | 50.0 |"));
  CHECK(contains(words, "| mutex mixed | mast 2 | 100 | 75% | 12.0 | 20.0 |"));
}

TEST_CASE("along the buffer: no entry is known, and no operation") {
  CacheRows rows = rows_of_figure("figure-6.2", {3, 7, 2});
  for (CacheRow& row : rows) row.entries = {};
  CHECK(contains(figure_of("figure-6.2", rows).figure.data.front().text,
                 "still,chained uniform,write,0,0,0,0,0,30\nstill,chained uniform,write,49999,0,0,0,0,30\n"));
  CHECK(contains(figure_of("figure-6.2", rows).figure.commands, "\nplot "));
  for (CacheRow& row : rows) row.cold = row.warm = {};
  const Findings none = figure_of("figure-6.2", rows);
  CHECK_FALSE(contains(none.figure.data.front().text, "still"));
  CHECK_FALSE(contains(none.figure.commands, "\nplot "));
}
