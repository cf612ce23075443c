// SPDX-License-Identifier: Apache-2.0
// Sizes and limits of the ray cache's tables.
// Assumes a device that holds a table of a thousand entries.
#include <doctest/doctest.h>

#include <string>

#include "passes/cache_forest.hpp"
#include "wavetracer/error.hpp"

using namespace wavetracer;
using namespace wavetracer::device;
using namespace wavetracer::test;

TEST_CASE("sizes of tables: shares, buckets, and errors that name limit and value") {
  const auto message = [](const CacheConfig& config, uint32_t transmitters) {
    try {
      make_cache_table(context(), config, transmitters, 10, 10);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const CacheTable table = make_cache_table(context(), chained(1000, 3), 3, 10, 10);
  CHECK(table.regions.size() == 3);
  CHECK(table.regions[2].entries == 333);
  CHECK(table.regions[2].first_entry == 666);
  CHECK(table.regions[2].buckets == 111);
  CHECK(table.regions[2].first_bucket == 222);
  CHECK(table.entries.size() == 999);
  CHECK(table.heads.size() == 333 + 2 * 999);
  CHECK(table.bytes() == 999 * 64 + 4 * (333 + 3 * 999) + 3 * 4 + 3 * sizeof(wt_cache_region) +
                             sizeof(wt_cache_counters) + 4 + sizeof(wt_cache_cycles));
  CHECK(make_cache_table(context(), chained(16, 64), 1, 10, 10).regions[0].buckets == 1);
  CacheConfig config = chained(1000);
  config.kind = "concurrent";
  CHECK(make_cache_table(context(), config, 3, 10, 10).regions[1].entries == 328);  // buckets are whole
  config.kind = "open";
  CHECK(make_cache_table(context(), config, 3, 10, 10).heads.size() == 2 * 999);

  const std::string small = message(chained(100), 20);
  CHECK(small.find("cache.buffer_size = 100 is too small: 20 transmitters") != std::string::npos);
  CHECK(small.find("give 320 or more") != std::string::npos);
  CHECK(message(chained(320), 20).empty());
  const std::string huge = message(chained(uint64_t{1} << 32), 1);
  CHECK(huge.find("cache.buffer_size = 4294967296 is too large: a table has 2147483648 entries at most") !=
        std::string::npos);
  const uint64_t fitting = context().info().max_buffer / sizeof(wt_cache_entry);
  if (fitting + 1 <= uint64_t{1} << 31) {
    const std::string large = message(chained(fitting + 1), 1);
    CHECK(large.find("cache.buffer_size = " + std::to_string(fitting + 1)) != std::string::npos);
    CHECK(large.find(std::to_string((fitting + 1) * sizeof(wt_cache_entry))) != std::string::npos);
    CHECK(large.find(std::to_string(context().info().max_buffer)) != std::string::npos);
  }
}
