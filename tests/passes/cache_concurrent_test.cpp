// SPDX-License-Identifier: Apache-2.0
// The concurrent table: every operation together with every other, one entry per key, holes, full regions, whole keys.
// Small enough for Oclgrind; the same with many more operations is in large_cache_test.cpp.
#include <set>

#include "passes/cache_mixed_check.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

size_t count_none(const std::vector<uint32_t>& slots) {
  return static_cast<size_t>(std::count(slots.begin(), slots.end(), WT_NONE));
}

const TableKind quantised{"concurrent", "readers", "quantised"}, exact{"concurrent", "readers", "exact"};

}  // namespace

TEST_CASE("concurrent cache: mixed operations leave what some order of them leaves") {
  for (const TableKind& kind : table_kinds("concurrent")) check_mixed(kind, 4096, 512, 0.8);
}

TEST_CASE("concurrent cache: more keys than entries") {
  for (const TableKind& kind : table_kinds("concurrent")) check_mixed(kind, 4096, 96, 4);
}

// This is a simulation of balls into bins: with 0.8 * 8 keys per bucket, 0.8% meet four full buckets in a row.
TEST_CASE("concurrent cache: at load 0.8 nearly every key finds a place, and is found there") {
  CacheProbe probe(quantised.config(2560), 1);
  const std::vector<uint32_t> slots = probe.put_keys(0, 2048, 0);
  const size_t dropped = count_none(slots), stored = 2048 - dropped;
  CHECK(dropped < 2048 / 50);
  std::set<uint32_t> places(slots.begin(), slots.end());
  places.erase(WT_NONE);
  CHECK(places.size() == stored);
  CHECK(probe.find_keys(2048) == slots);
  CHECK(probe.counters().stored == stored);
  CHECK(probe.counters().exhausted == dropped);
  CHECK(probe.table.used.read_one(0) == stored);
  CHECK(probe.put_keys(0, 2048, 1) == slots);
  CHECK(probe.counters().duplicates == stored);
}

TEST_CASE("concurrent cache: a full region drops what has no place, and keeps the rest") {
  CacheProbe probe(quantised.config(16), 1);
  const std::vector<uint32_t> slots = probe.put_keys(0, 64, 0);
  CHECK(count_none(slots) == 48);
  CHECK(probe.counters().stored == 16);
  CHECK(probe.counters().dropped == 48);
  CHECK(probe.counters().exhausted == 48);
  CHECK(probe.find_keys(64) == slots);
}

// A key that was stored beyond a full bucket must be found, and not be stored again before it, if the bucket has holes.
TEST_CASE("concurrent cache: holes lose no key and give none a second entry") {
  CacheProbe probe(quantised.config(64), 1);
  std::vector<uint32_t> slots = probe.put_keys(0, 64, 0);
  std::vector<uint32_t> removed, kept_keys;
  for (uint32_t key = 0; key < 64; ++key) {
    if (slots[key] == WT_NONE) continue;
    if (slots[key] % 2 == 0)
      removed.push_back(slots[key]);
    else
      kept_keys.push_back(key);
  }
  REQUIRE(removed.size() > 20);
  probe.remove(removed);
  std::vector<uint32_t> found = probe.find_keys(64);
  CHECK(count_none(found) == 64 - kept_keys.size());
  for (const uint32_t key : kept_keys) CHECK(found[key] == slots[key]);

  const uint32_t before = probe.counters().duplicates;
  const std::vector<uint32_t> again = probe.put_keys(0, 64, 0);
  CHECK(probe.counters().duplicates - before == kept_keys.size());
  for (const uint32_t key : kept_keys) CHECK(again[key] == slots[key]);
  found = probe.find_keys(64);
  CHECK(found == again);
  std::vector<uint32_t> places;
  for (const uint32_t slot : found)
    if (slot != WT_NONE) places.push_back(slot);
  CHECK(places.size() > kept_keys.size());  // holes are used again
  CHECK(std::set<uint32_t>(places.begin(), places.end()).size() == places.size());
}

TEST_CASE("concurrent cache: entries of before a region's frame are stale, and replaced in place") {
  CacheProbe probe(quantised.config(256), 1);
  const std::vector<uint32_t> slots = probe.put_keys(0, 100, 2);
  probe.set_since(3);
  CHECK(count_none(probe.find_keys(100)) == 100);
  CHECK(probe.put_keys(0, 100, 3) == slots);
  CHECK(probe.counters().replaced == 100);
  CHECK(probe.find_keys(100) == slots);
}

TEST_CASE("concurrent cache: exact keys differ by the last bit of a ray, quantised ones share its cell") {
  const Ray ray{{1, 2, 3}, {0.6f, 0.8f, 0}, 7};
  Ray moved = ray, turned = ray;
  moved.origin[1] = std::nextafter(2.0f, 3.0f);
  turned.direction[1] = std::nextafter(0.8f, 1.0f);
  for (const TableKind& kind : {quantised, exact}) {
    CAPTURE(kind.name());
    CacheProbe probe(kind.config(64), 1);
    probe.put(ray, 5, 0, 42);
    const uint32_t others = kind.key == "exact" ? WT_NONE : 42u;
    CHECK(probe.find(ray, 5, 0) == 42);
    CHECK(probe.find(moved, 5, 0) == others);
    CHECK(probe.find(turned, 5, 0) == others);
    CHECK(probe.find(ray, 6, 0) == WT_NONE);
  }
}
