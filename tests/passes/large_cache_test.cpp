// SPDX-License-Identifier: Apache-2.0
// Millions of operations at once on every table of the ray cache, each answer checked where it is given.
// GPUs do 10^8 per table; CPUs do WAVETRACER_CACHE_OPERATIONS, or as many as a few seconds allow. The small cases are
// in cache_open_test.cpp, cache_concurrent_test.cpp and cache_chained_test.cpp.
#include <array>
#include <cstdlib>

#include "passes/cache_mixed_check.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

uint64_t operation_count() {
  if (const char* text = std::getenv("WAVETRACER_CACHE_OPERATIONS")) return std::strtoull(text, nullptr, 10);
  return context().info().cpu ? 2000000 : 100000000;
}

}  // namespace

TEST_CASE("ray cache: millions of mixed operations on every table") {
  const uint64_t operations = operation_count();
  for (const CacheKind name : std::to_array<CacheKind>({"chained", "open", "concurrent"}))
    for (const TableKind& kind : table_kinds(name)) check_mixed(kind, operations, operations / 8, 0.8);
}

// Five keys, so that readers and writers of one entry meet all the time.
TEST_CASE("ray cache: few keys that all work-items want") {
  for (const CacheKind name : std::to_array<CacheKind>({"chained", "open", "concurrent"}))
    for (const TableKind& kind : table_kinds(name)) check_mixed(kind, operation_count(), 96, 0.06, true);
}
