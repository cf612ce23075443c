// SPDX-License-Identifier: Apache-2.0
// Key, hashes and mapping of the ray cache (include/wavetracer/device/cache.h) against 128-bit arithmetic and loops
// over bits, and the thesis' own versions (thesis_cache.hpp).
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "passes/thesis_cache.hpp"
#include "passes/triangles.hpp"
#include "wavetracer/device/cache.h"

using namespace wavetracer;
using namespace wavetracer::device;
using namespace wavetracer::test;

namespace {

__extension__ using uint128 = unsigned __int128;

uint64_t random64(Random& random) { return uint64_t{random.below(WT_NONE)} << 32 | random.below(WT_NONE); }

uint64_t cells_of(const glm::dvec3& direction, uint32_t division) {
  const Float3 d = to_float(direction);
  return wt_cache_cells(d[0], d[1], d[2], division);
}

// P. Morin, Open Data Structures, 5.2.3.
uint32_t morin(const std::vector<uint32_t>& numbers) {
  constexpr uint128 p = (uint128{1} << 32) - 5;
  uint128 s = 0, zi = 1;
  for (const uint32_t x : numbers) {
    s += zi * ((x * 0x5067d19du) >> 1);  // 32-bit product, to 31 bits
    zi = zi * 0x64b6055a % p;
  }
  return static_cast<uint32_t>((s + zi * (p - 1)) % p);
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

double distance(uint64_t a, uint64_t b) { return static_cast<double>(a > b ? a - b : b - a); }

}  // namespace

TEST_CASE("cells are in order, within the division, and as wide as each other") {
  for (const uint32_t division : {1u, 2u, 3u, 1000u, 200000u, WT_CACHE_MAX_DIVISION}) {
    CAPTURE(division);
    CHECK(wt_cache_cell(-1, division) == 0);
    CHECK(wt_cache_cell(1, division) == division - 1);
    CHECK(wt_cache_cell(1.0000001f, division) == division - 1);  // a unit vector may be rounded up
    CHECK(wt_cache_cell(-1.0000001f, division) == 0);
    uint32_t last = 0;
    double wrong = 0;
    for (int i = -5000; i <= 5000; ++i) {
      const auto x = static_cast<float>(i / 5000.0);
      const uint32_t cell = wt_cache_cell(x, division);
      CHECK(cell >= last);
      last = cell;
      wrong = std::max(wrong, std::abs((double{x} + 1) * division / 2 - (cell + 0.5)));
    }
    CHECK(wrong <= 0.5 + division * 1.2e-7);
  }
  const uint32_t top = WT_CACHE_MAX_DIVISION - 1;
  const uint64_t cells = wt_cache_cells(1, -1, 1, WT_CACHE_MAX_DIVISION);
  CHECK(cells == (uint64_t{top} | uint64_t{top} << 42));
}

TEST_CASE("hash 1 is the formula it is taken from; the listing leaves the range of its integers") {
  Random random(1);
  size_t wrong = 0, listing_wrong = 0;
  constexpr size_t count = 20000;
  for (size_t i = 0; i < count; ++i) {
    const uint64_t cells = cells_of(random.direction(), 200000);
    const uint32_t left = i % 10 ? random.below(1000000) : WT_NONE, surface = random.below(2000);
    const auto x = static_cast<uint32_t>(cells & 0x1FFFFF), y = static_cast<uint32_t>(cells >> 21 & 0x1FFFFF);
    const auto z = static_cast<uint32_t>(cells >> 42);
    const uint32_t exact = morin({left, surface, x, y, z});
    wrong += wt_cache_hash1(cells, left, surface) != uint64_t{exact} << 32;
    thesis::CacheKey key;
    key.primitiveIndex = left;
    key.instanceId = surface;
    key.div_x = x;
    key.div_y = y;
    key.div_z = z;
    listing_wrong += key.calc_hash1() != exact;
  }
  CHECK(wrong == 0);
  CHECK(listing_wrong > count * 9 / 10);
}

TEST_CASE("x modulo 2^32 - 5 without a division") {
  constexpr uint64_t p = (uint64_t{1} << 32) - 5;
  Random random(2);
  size_t wrong = 0;
  for (const uint64_t x : {uint64_t{0}, p - 1, p, p + 1, p * p, p * p - 1, p << 32, ~uint64_t{0}, ~uint64_t{0} - 1})
    wrong += wt_cache_modulo(x) != x % p;
  for (uint64_t k = 1; k < 3000; ++k)
    for (const uint64_t x : {k * p - 1, k * p, k * p + 1, (p + 6) * p - k, random64(random)})
      wrong += wt_cache_modulo(x) != x % p;
  CHECK(wrong == 0);
}

TEST_CASE("the mapping is a multiply-high: it reaches every bucket, in order and evenly") {
  Random random(3);
  size_t wrong = 0;
  for (int i = 0; i < 100000; ++i) {
    const uint64_t hash = random64(random);
    const uint32_t buckets = i % 2 ? random.below(WT_NONE) + 1 : 1 + random.below(100);
    wrong += wt_cache_bucket(hash, buckets) != static_cast<uint32_t>(uint128{hash} * buckets >> 64);
  }
  CHECK(wrong == 0);
  // The first hash of bucket b is the smallest that is at least b / buckets of 2^64; the one before belongs to the
  // bucket before.
  for (uint32_t buckets = 1; buckets <= 5000; ++buckets)
    for (uint32_t b = 1; b < buckets; ++b) {
      const auto first = static_cast<uint64_t>(((uint128{b} << 64) + buckets - 1) / buckets);
      wrong += wt_cache_bucket(first, buckets) != b || wt_cache_bucket(first - 1, buckets) != b - 1;
    }
  constexpr uint32_t many = 1u << 26;
  for (uint32_t b = 1; b < many; ++b) {
    const uint64_t first = uint64_t{b} << 38;
    wrong += wt_cache_bucket(first, many) != b || wt_cache_bucket(first - 1, many) != b - 1;
  }
  CHECK(wrong == 0);
  CHECK(wt_cache_bucket(~uint64_t{0}, 5000) == 4999);
}

TEST_CASE("the thesis' mapping leaves the upper half of the table unused, and skips buckets where 24 bits end") {
  for (const int buckets : {100, 5000, 1 << 26}) {
    const uint32_t highest = thesis::getBucketIndex(WT_NONE, buckets);
    CHECK(highest <= static_cast<uint32_t>(buckets) / 2);
    CHECK(wt_cache_bucket(uint64_t{WT_NONE} << 32, static_cast<uint32_t>(buckets)) >=
          static_cast<uint32_t>(buckets) - 1);
  }
  size_t odd = 0, even = 0;
  for (uint64_t hash = 0; hash <= WT_NONE; hash += 61) {
    const uint32_t bucket = thesis::getBucketIndex(static_cast<uint32_t>(hash), 1 << 26);
    if (bucket > 1u << 24) ++(bucket % 2 ? odd : even);
  }
  CHECK(odd == 0);
  CHECK(even > 30000000);
}

TEST_CASE("hash 2 interleaves the upper 12 bits of each component") {
  Random random(4);
  const wt_cache_widths widths{18, 7, 20};
  for (int i = 0; i < 2000; ++i) {
    const uint64_t cells = cells_of(random.direction(), 200000);
    const uint32_t left = random.below(1 << 20), surface = random.below(1 << 7);
    const uint64_t upper[5] = {(cells & 0x1FFFFF) >> 6, (cells >> 21 & 0x1FFFFF) >> 6, cells >> 42 >> 6,
                               uint64_t{surface} << 5, left >> 8};
    uint64_t expected = 0;
    for (int bit = 0; bit < 12; ++bit)
      for (int component = 0; component < 5; ++component)
        expected |= (upper[component] >> bit & 1) << (4 + 5 * bit + component);
    CHECK(wt_cache_hash2(cells, left, surface, widths) == expected);
    CHECK(wt_cache_hash(2, cells, left, surface, widths) == expected);
    CHECK(wt_cache_hash(3, cells, left, surface, widths) == expected + wt_cache_hash1(cells, left, surface));
  }
}

TEST_CASE("hash 2 keeps neighbours near; the thesis' lowest 7 bits do not") {
  Random random(5);
  std::vector<double> near, far, listing_near, listing_far;
  const wt_cache_widths widths{18, 10, 10};
  const auto hash = [&](const glm::dvec3& d) { return wt_cache_hash2(cells_of(d, 200000), 17, 8, widths); };
  const auto listing = [](const glm::dvec3& d) {
    const Float3 f = to_float(d);
    return uint64_t{thesis::CacheKey(8, 17, f[0], f[1], f[2], 2).hash};
  };
  for (int i = 0; i < 4001; ++i) {
    const glm::dvec3 d = random.direction(), other = random.direction();
    const glm::dvec3 neighbour = glm::normalize(d + 2e-3 * random.direction());
    near.push_back(distance(hash(d), hash(neighbour)));
    far.push_back(distance(hash(d), hash(other)));
    listing_near.push_back(distance(listing(d), listing(neighbour)));
    listing_far.push_back(distance(listing(d), listing(other)));
  }
  CHECK(median(near) < 1e-3 * median(far));
  CHECK(median(listing_near) > 0.5 * median(listing_far));
}

TEST_CASE("the device computes the same keys, hashes and buckets") {
  Random random(6);
  const uint32_t count = 4000;
  std::vector<float> directions;
  std::vector<uint32_t> left, surfaces;
  for (uint32_t i = 0; i < count; ++i) {
    for (const float x : to_float(random.direction())) directions.push_back(x);
    left.push_back(i % 7 ? random.below(5000000) : WT_NONE);
    surfaces.push_back(i % 7 ? random.below(30000) : WT_NONE);
  }
  const auto d = context().buffer(directions, "directions");
  const auto l = context().buffer(left, "left"), s = context().buffer(surfaces, "surfaces");
  auto out = context().buffer<uint64_t>(3 * count, "keys");
  gpu::Kernel kernel = context().kernel("probe_cache_key", "cache_keys");
  const wt_cache_widths widths{18, 15, 23};
  for (const uint32_t method : {1u, 2u, 3u})
    for (const uint32_t division : {200000u, WT_CACHE_MAX_DIVISION}) {
      const uint32_t buckets = 7 + method * 1000003;
      kernel({count, 64}, Stage::transfer, d, l, s, count, division, method, widths, buckets, out);
      const std::vector<uint64_t> words = out.read();
      size_t wrong = 0;
      for (uint32_t i = 0; i < count; ++i) {
        const uint64_t cells =
            wt_cache_cells(directions[3 * i], directions[3 * i + 1], directions[3 * i + 2], division);
        const uint64_t hash = wt_cache_hash(method, cells, left[i], surfaces[i], widths);
        wrong += words[3 * i] != cells || words[3 * i + 1] != hash;
        wrong += words[3 * i + 2] != (uint64_t{wt_cache_tag(cells, left[i])} << 32 | wt_cache_bucket(hash, buckets));
      }
      CHECK(wrong == 0);
    }
}

TEST_CASE("tags are never 0, and tell keys apart as 32 random bits do") {
  Random random(7);
  std::vector<uint32_t> tags;
  for (uint32_t i = 0; i < 100000; ++i) tags.push_back(wt_cache_tag(cells_of({1, 0, 0}, 200000) + i, i % 3));
  std::ranges::sort(tags);
  CHECK(tags.front() > 0);
  CHECK(std::ranges::unique(tags).size() < 10);  // 1.2 expected
}
