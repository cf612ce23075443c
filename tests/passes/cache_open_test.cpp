// SPDX-License-Identifier: Apache-2.0
// The open-addressed table under locks: mixed operations, wear, purging by position and by precision, and the two
// faults of the thesis' listing C.3, which runs as printed for comparison. It is small enough for Oclgrind.
#include "passes/cache_mixed_check.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

CacheConfig open_config(CacheLocking locking, uint64_t entries) {
  return TableKind{"open", locking, "quantised"}.config(entries);
}

// Rays in a plane, by their angle; each key differs from the others.
Ray ray_at(float degrees) {
  const double radians = degrees * 3.14159265358979 / 180;
  return {{0, 0, 0}, {static_cast<float>(std::cos(radians)), static_cast<float>(std::sin(radians)), 0}, 3};
}

// Returns two rays of one primitive that need one slot of the table.
std::pair<Ray, Ray> rays_of_one_slot(const CacheTable& table, uint32_t left) {
  const auto slot = [&](const Ray& ray) {
    const uint64_t cells =
        device::wt_cache_cells(ray.direction[0], ray.direction[1], ray.direction[2], table.config.division);
    return device::wt_cache_bucket(
        device::wt_cache_hash(table.config.hash_method, cells, left, ray.surface, table.widths),
        table.regions[0].entries);
  };
  const Ray first = ray_at(0);
  for (float degrees = 1; degrees < 180; ++degrees)
    if (slot(ray_at(degrees)) == slot(first)) return {first, ray_at(degrees)};
  FAIL("no two rays of one slot");
  return {};
}

// The listing's table with two nodes: the mapping reaches only the first, so all keys meet there.
class ThesisTable {
 public:
  bool put(uint64_t cells, uint32_t left) {
    auto taken = context().buffer<uint32_t>(1, "taken");
    kernel("thesis_put")({1, 1}, Stage::transfer, nodes_, word(cells), word(left), 1u, stamp, taken);
    return taken.read_one(0) != 0;
  }
  // Returns the primitive that thesis_put stores under a key.
  static uint32_t stored(uint64_t cells, uint32_t left) { return static_cast<uint32_t>(cells ^ cells >> 32) + left; }
  uint32_t find(uint64_t cells, uint32_t left) {
    auto t = context().buffer<float>(1, "t");
    auto primitive = context().buffer<uint32_t>(1, "primitive"), surface = context().buffer<uint32_t>(1, "surface");
    kernel("thesis_find")({1, 1}, Stage::transfer, nodes_, word(cells), word(left), 1u, stamp, t, primitive, surface);
    return primitive.read_one(0);
  }

  static constexpr uint32_t readers = 5;

 private:
  static constexpr uint32_t stamp = 1;
  gpu::Buffer<uint32_t> nodes_ = context().buffer(std::vector<uint32_t>(64), "thesis nodes");

  template <class T>
  static gpu::Buffer<T> word(T value) {
    return context().buffer(std::vector<T>{value}, "word");
  }
  static gpu::Kernel kernel(const char* name) {
    return context().kernel("probe_thesis_cache", name, {{"WT_NODES", "2"}, {"WT_READERS", std::to_string(readers)}});
  }
};

}  // namespace

TEST_CASE("open cache: mixed operations leave what some order of them leaves") {
  for (const TableKind& kind : table_kinds("open")) check_mixed(kind, 4096, 512, 0.8);
}

TEST_CASE("open cache: the last writer has the slot") {
  for (const CacheLocking locking : std::to_array<CacheLocking>({"mutex", "readers"})) {
    CAPTURE(locking);
    CacheProbe probe(open_config(locking, 16), 1);
    const auto [a, b] = rays_of_one_slot(probe.table, 5);
    const uint32_t slot = probe.put(a, 5, 0, 1);
    CHECK(probe.put(a, 5, 0, 9) == slot);
    CHECK(probe.counters().duplicates == 1);
    CHECK(probe.find(a, 5, 0) == 1);
    CHECK(probe.put(b, 5, 0, 2) == slot);
    CHECK(probe.counters().replaced == 1);
    CHECK(probe.find(a, 5, 0) == WT_NONE);
    CHECK(probe.find(b, 5, 0) == 2);
  }
}

TEST_CASE("open cache: an entry that was read often enough is worn until it is written anew") {
  CacheConfig config = open_config("readers", 64);
  config.readers_number = 3;
  CacheProbe probe(config, 1);
  const Ray ray = ray_at(10);
  for (uint32_t writing = 0; writing < 2; ++writing) {
    probe.put(ray, 5, 0, 40 + writing);
    for (int read = 0; read < 3; ++read) CHECK(probe.find(ray, 5, 0) == 40 + writing);
    CHECK(probe.find(ray, 5, 0) == WT_NONE);
  }
  CHECK(probe.counters().stored == 2);
  CHECK(probe.counters().replaced == 1);

  config = open_config("mutex", 64);
  CacheProbe mutex(config, 1);
  mutex.put(ray, 5, 0, 40);
  for (int read = 0; read < 20; ++read) CHECK(mutex.find(ray, 5, 0) == 40);
}

TEST_CASE("open cache: entries of before a region's frame are stale, and replaced at once") {
  CacheProbe probe(open_config("readers", 64), 1);
  const Ray ray = ray_at(10);
  probe.put(ray, 5, 3, 40);
  probe.set_since(4);
  CHECK(probe.find(ray, 5, 4) == WT_NONE);
  CHECK(probe.counters().stale == 1);
  probe.put(ray, 5, 4, 41);
  CHECK(probe.find(ray, 5, 4) == 41);
}

// Section 3.2.3: the content of the slot answers rays of other cells too, as far as the residual allows, and no
// further.
TEST_CASE("open cache: precision purging goes by the residual") {
  CacheConfig config = open_config("readers", 16);
  config.purge = "precision";
  config.residual_value = 0.125;
  config.hash_method = 2;  // neighbours share a slot
  CacheProbe probe(config, 1);
  const Ray ray{{1, 2, 3}, {0.6f, 0.8f, 0}, 3};
  probe.put(ray, 5, 0, 40);
  Ray near = ray, far = ray;
  near.origin[0] += 0.0625f;
  near.origin[2] -= 0.03125f;
  near.direction = {0.60001f, 0.79999f, 0};
  far.origin[0] += 0.0625f;
  far.origin[2] -= 0.0625f;
  far.origin[1] += 0.015625f;
  CHECK(probe.find(near, 5, 0) == 40);
  CHECK(probe.find(far, 5, 0) == WT_NONE);
  CHECK(probe.find(near, 6, 0) == WT_NONE);  // another primitive
  probe.put(far, 5, 0, 41);
  CHECK(probe.find(far, 5, 0) == 41);
}

// Fault 8: getFromCache compares neither key nor hash, so every ray that asks a slot gets its content.
TEST_CASE("open cache: another key's entry is no answer, as it is by the thesis' listing") {
  ThesisTable thesis;
  const uint64_t a_cells = device::wt_cache_cells(1, 0, 0, 200000), b_cells = device::wt_cache_cells(0, 1, 0, 200000);
  CHECK(thesis.put(a_cells, 5));
  CHECK(thesis.find(b_cells, 6) == ThesisTable::stored(a_cells, 5));
  CHECK(ThesisTable::stored(a_cells, 5) != ThesisTable::stored(b_cells, 6));

  CacheProbe probe(open_config("readers", 16), 1);
  const auto [a, b] = rays_of_one_slot(probe.table, 5);
  probe.put(a, 5, 0, 40);
  CHECK(probe.find(b, 5, 0) == WT_NONE);
  CHECK(probe.find(a, 5, 0) == 40);
}

// Fault 9: the write lock stays taken until readers_number reads, so a slot that is not asked again is lost.
TEST_CASE("open cache: a written slot takes another key at once, as it does not by the thesis' listing") {
  ThesisTable thesis;
  const uint64_t a_cells = device::wt_cache_cells(1, 0, 0, 200000), b_cells = device::wt_cache_cells(0, 1, 0, 200000);
  CHECK(thesis.put(a_cells, 5));
  for (int attempt = 0; attempt < 10; ++attempt) CHECK_FALSE(thesis.put(b_cells, 6));
  for (uint32_t read = 0; read < ThesisTable::readers; ++read)
    CHECK(thesis.find(a_cells, 5) == ThesisTable::stored(a_cells, 5));
  CHECK(thesis.put(b_cells, 6));

  CacheProbe probe(open_config("readers", 16), 1);
  const auto [a, b] = rays_of_one_slot(probe.table, 5);
  probe.put(a, 5, 0, 40);
  CHECK(probe.put(b, 5, 0, 41) != WT_NONE);
  CHECK(probe.find(b, 5, 0) == 41);
}
