// SPDX-License-Identifier: Apache-2.0
// Regions of a cache's table: their claims and their table, on made rows.
// Correlations are those of lists whose coefficient is known.
#include "study/table_regions.hpp"
#include <doctest/doctest.h>
#include <algorithm>
#include "study/cache_verdicts.hpp"
#include "study/text.hpp"

using namespace wavetracer::study;
using namespace cache_verdicts;

namespace {

// Rows of figure 6.6 with regions, whose look-ups and nanoseconds a read are given, in one setting.
CacheMeasurement with_regions(const std::string& setting, const std::vector<double>& lookups,
                              const std::vector<double>& read) {
  CacheMeasurement out = made_measurement(*find_experiment("figure-6.6").study(), {50000}, same);
  const CacheRow whole = *find_cached(out.rows, setting, 50000);
  for (size_t i = 0; i < lookups.size(); ++i) {
    CacheRow row = whole;
    row.region = static_cast<uint32_t>(i + 1);
    row.transmitter = "mast " + std::to_string(i + 1);
    row.counts.lookups = lookups[i];
    row.warm.lookup_s = 1e-9 * read[i] * lookups[i];
    out.rows.push_back(row);
  }
  return out;
}

}  // namespace

TEST_CASE("regions whose values go along, against each other, and too few of them") {
  const auto words = [](const std::vector<double>& read, bool opposite) {
    std::vector<double> lookups;
    for (size_t i = 1; i <= read.size(); ++i) lookups.push_back(100.0 * static_cast<double>(i));
    return words_of(across_regions({"mutex mixed"}, region_lookups, read_ns,
                                   opposite)(with_regions("mutex mixed", lookups, read).rows));
  };
  CHECK(words({1, 2, 3, 4, 5, 6.1}, false) == "\"mutex mixed\": yes (1.00)");
  CHECK(words({1, 2, 3, 4, 5, 6.1}, true) == "\"mutex mixed\": no (1.00)");
  CHECK(words({6.1, 5, 4, 3, 2, 1}, true) == "\"mutex mixed\": yes (-1.00)");
  CHECK(words({1, 2, 2, 1}, false) == "\"mutex mixed\": undecided (0.00)");
  CHECK(words({1, 2, 3}, false) == "\"mutex mixed\": undecided (1.00)");
  CHECK(words({1, 2}, false) == "not measured");
}

TEST_CASE("rows of the whole frame and of regions are not taken for each other, in whatever order") {
  CacheMeasurement made = with_regions("mutex mixed", {100, 200, 300}, {10, 20, 40});
  std::ranges::rotate(made.rows, made.rows.end() - 3);
  CHECK(find_cached(made.rows, "mutex mixed", 50000)->region == 0);
  const std::vector<const CacheRow*> regions = regions_of(made.rows, "mutex mixed");
  REQUIRE(regions.size() == 3);
  CHECK(regions[2]->transmitter == "mast 3");
  CHECK(regions_of(made.rows, "mutex Morton").empty());
}

TEST_CASE("figures 6.6 and 6.7 launch from several masts of the built-in city, and from those of a file") {
  for (const char* name : {"figure-6.6", "figure-6.7"}) {
    CHECK(find_experiment(name).study()->by_transmitter);
    CHECK(experiment_config(find_experiment(name), "", {}).transmitters.size() == 4);
  }
  CHECK(experiment_config(find_experiment("figure-6.2"), "", {}).transmitters.size() == 1);
}
