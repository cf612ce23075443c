// SPDX-License-Identifier: Apache-2.0
// Tests entries of a table whose groups can be counted by hand, and hits that a random generator spreads.
#include "study/entry_summary.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include <random>

using namespace wavetracer;
using namespace wavetracer::study;

namespace {

struct Entry {
  uint32_t slot, region, depth, hits, read, write;
};

CacheEntryRows rows_of(const std::vector<Entry>& entries) {
  CacheEntryRows out;
  for (const Entry& one : entries) {
    out.frame.push_back(0);
    out.slot.push_back(one.slot);
    out.region.push_back(one.region);
    out.depth.push_back(one.depth);
    out.hits.push_back(one.hits);
    out.age.push_back(0);
    out.length_m.push_back(1);
    out.read_cycles.push_back(one.read);
    out.write_cycles.push_back(one.write);
  }
  return out;
}

// Makes 20,000 entries in a row, whose hits are `hits_of` their slot.
template <class HitsOf>
EntrySummary spread(HitsOf hits_of) {
  std::vector<Entry> entries;
  for (uint32_t slot = 0; slot < 20000; ++slot) entries.push_back({slot, 0, 1, hits_of(slot), 100, 100});
  return summary_of(rows_of(entries));
}

}  // namespace

TEST_CASE("groups by depth and region: what no search finds is in no depth, what never answered has no time") {
  const EntrySummary found = summary_of(rows_of({{0, 0, 1, 4, 100, 50},
                                                 {1, 0, 1, 0, 0, 70},
                                                 {5, 0, 2, 2, 300, 90},
                                                 {9, 1, 0, 0, 0, 200},
                                                 {10, 1, 3, 6, 500, 110}}));
  REQUIRE(found.by_depth.size() == 3);
  CHECK(found.by_depth[0].entries == 2);
  CHECK(found.by_depth[0].hits == 4);
  CHECK(found.by_depth[0].read_cycles == 100);
  CHECK(found.by_depth[0].write_cycles == 60);
  CHECK(found.by_depth[2].number == 3);
  REQUIRE(found.by_region.size() == 2);
  CHECK(found.by_region[0].entries == 3);
  CHECK(found.by_region[0].read_cycles == 200);
  CHECK(found.by_region[1].hits == 6);
  CHECK(found.by_region[1].write_cycles == 155);
  CHECK(read_levels(found).bucket.value == 100);
  CHECK(read_levels(found).below.value == 400);
  CHECK(write_levels(found).bucket.value == 60);
  CHECK(write_levels(found).bucket.error == doctest::Approx(10));  // 50 and 70
}

TEST_CASE("samples lie at equal distances along the table, and are all entries of a small one") {
  const EntrySummary few = summary_of(rows_of({{3, 0, 1, 4, 100, 50}, {7, 1, 2, 0, 0, 70}}));
  REQUIRE(few.samples.size() == 2);
  CHECK(few.samples[1].slot == 7);
  CHECK(few.samples[1].region == 1);
  CHECK(few.samples[1].depth == 2);
  CHECK(few.samples[0].hits == 4);
  CHECK(few.samples[0].read_cycles == 100);
  CHECK(few.samples[1].write_cycles == 70);
  const EntrySummary many = spread([](uint32_t slot) { return slot; });
  REQUIRE(many.samples.size() == entry_samples);
  for (uint32_t i = 0; i < entry_samples; ++i) CHECK(many.samples[i].slot == 50 * i);
  CHECK(summary_of({}).samples.empty());
}

TEST_CASE("averages of buckets and of what is below them, and tables that have none") {
  const auto with = [](uint32_t bucket, uint32_t below) {
    return summary_of(rows_of({{0, 0, 1, 1, bucket, bucket}, {1, 0, 2, 1, below, below}}));
  };
  CHECK(read_levels(with(300, 200)).bucket.value == 300);
  CHECK(write_levels(with(300, 200)).below.value == 200);
  CHECK(write_levels(with(300, 200)).below.error == 200);    // one entry: nothing is known
  CHECK(std::isnan(read_levels(with(0, 0)).bucket.value));   // no clock
  CHECK(std::isnan(read_levels(with(300, 0)).below.value));  // no entry further down answered
  CHECK(std::isnan(read_levels(summary_of({})).bucket.value));
}

TEST_CASE("one operation in a hundred that is interrupted does not move a mean") {
  std::vector<Entry> entries;
  for (uint32_t slot = 0; slot < 1000; ++slot) entries.push_back({slot, 0, 1, 1, slot % 100 ? 120u : 4000000u, 120});
  CHECK(summary_of(rows_of(entries)).by_depth[0].read_cycles == 120);
}

TEST_CASE("hits by chance: both numbers are near 1; more even: less; crowded entries: dispersion; places: clustering") {
  std::mt19937 random(5);
  std::poisson_distribution<uint32_t> poisson(3);
  const EntrySummary chance = spread([&](uint32_t) { return poisson(random); });
  CHECK(chance.dispersion == doctest::Approx(1).epsilon(0.05));
  CHECK(chance.clustering == doctest::Approx(1).epsilon(0.6));  // there are 50 runs: a standard deviation of 0.2
  CHECK(measured_dispersion(chance).error == doctest::Approx(std::sqrt(2 / 19999.0) * chance.dispersion));
  CHECK(measured_clustering(chance).error == doctest::Approx(std::sqrt(2 / 49.0) * chance.clustering));
  const EntrySummary alike = spread([](uint32_t) { return 2u; });
  CHECK(alike.dispersion == 0);
  CHECK(alike.clustering == 0);
  const EntrySummary crowded = spread([&](uint32_t) { return random() % 10 == 0 ? 30u : 0u; });  // anywhere
  CHECK(crowded.dispersion == doctest::Approx(27).epsilon(0.1));
  CHECK(crowded.clustering < 2);
  const EntrySummary clustered = spread([&](uint32_t slot) { return poisson(random) + (slot < 4000 ? 1u : 0u); });
  CHECK(clustered.clustering > 3);
}

TEST_CASE("no entries, and entries that were never asked") {
  CHECK(std::isnan(measured_dispersion(summary_of({})).value));
  CHECK(std::isnan(measured_clustering(summary_of({})).value));
  CHECK(std::isnan(measured_dispersion(spread([](uint32_t) { return 0u; })).value));
  CHECK(summary_of({}).runs.empty());
}
