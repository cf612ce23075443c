// SPDX-License-Identifier: Apache-2.0
// scan: exclusive prefix sums against the standard library's, for counts around the sizes of tiles and chunks.
// Forms with few work-items and few chunks take both launches at a few hundred counts, on any device.
#include "passes/scan.hpp"

#include <doctest/doctest.h>

#include <initializer_list>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

void check_scan(Scan& scan, std::initializer_list<uint32_t> lengths, uint32_t below) {
  Random random(1);
  for (const uint32_t count : lengths) {
    CAPTURE(count);
    std::vector<uint32_t> values(count + 3, 7);  // the values behind must not change
    for (uint32_t i = 0; i < count; ++i) values[i] = random.below(below);
    std::vector<uint32_t> expected = values;
    std::exclusive_scan(values.begin(), values.begin() + count, expected.begin(), 0u);
    gpu::Buffer<uint32_t> buffer = context().buffer(values, "counts");
    CHECK(scan(buffer, count) == std::accumulate(values.begin(), values.begin() + count, 0u));
    CHECK(buffer.read() == expected);
  }
}

}  // namespace

TEST_CASE("exclusive sums in place, and their total") {
  Scan scan(context());
  check_scan(scan, {0, 1, 2, 15, 16, 17, 1000, 1023, 1024, 1025, 4095, 4096, 4097, 100000}, 17);
}

TEST_CASE("exclusive sums of several chunks, by work-groups and by single work-items") {
  SUBCASE("work-groups, tiles of 64") {
    Scan scan(context(), {.items = 16, .alone = 64, .chunks = 3});
    check_scan(scan, {63, 64, 65, 127, 128, 129, 191, 192, 193, 194, 383, 384, 385, 1000}, 17);
  }
  SUBCASE("work-items, tiles of 4") {
    Scan scan(context(), {.items = 1, .alone = 0, .chunks = 5});
    check_scan(scan, {1, 2, 3, 4, 5, 19, 20, 21, 39, 40, 41, 777}, 17);
  }
  SUBCASE("more chunks than work-items") {
    Scan scan(context(), {.items = 4, .alone = 0, .chunks = 1024});
    check_scan(scan, {15, 16, 17, 500}, 17);
  }
}

TEST_CASE("sums wrap, as the standard library's of 32-bit words do") {
  Scan scan(context(), {.items = 4, .alone = 16, .chunks = 2});
  check_scan(scan, {10, 100}, ~0u);
}

TEST_CASE("a scan refuses more counts than the buffer has") {
  Scan scan(context());
  auto counts = context().buffer<uint32_t>(10, "counts");
  CHECK_THROWS_WITH_AS(scan(counts, 11), "scan: 11 counts of a buffer of 10", std::invalid_argument);
}
