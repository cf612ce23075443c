// SPDX-License-Identifier: Apache-2.0
// radix_sort: all forms on the test's device against std::stable_sort, for counts around tiles and chunks, kinds of
// keys, ranges of bits, and wrong arguments. The largest counts make several chunks of every form.
#include "passes/radix_sort.hpp"

#include <array>
#include <bit>
#include <compare>
#include <limits>
#include <span>
#include <stdexcept>

#include "passes/sort_cases.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

// Calls check with a sort of each form.
template <class Key, class Check>
void for_each_form(Payload payload, Check check) {
  for (const NamedForm& form : sort_forms) {
    CAPTURE(form.name);
    RadixSort<Key> sort(context(), payload, form.form);
    check([&](const SortCase<Key>& c) { check_sort(sort, payload, c); });
  }
}

// IEEE floats to keys whose order as integers is the total order of the floats.
uint32_t ordered_bits(float x) {
  const auto bits = std::bit_cast<uint32_t>(x);
  return bits ^ (bits >> 31 ? 0xFFFFFFFFu : 0x80000000u);
}

}  // namespace

TEST_CASE("radix sort: counts around powers of two, tiles and chunks") {
  for_each_form<uint32_t>(Payload::words, [](auto check) {
    for (const uint32_t n : {0u, 1u, 2u, 33u, 255u, 1023u, 1024u, 1025u, 4607u, 4608u, 4609u, 9300u})
      check({random_keys<uint32_t>(n, n), 4, 12});
  });
  for_each_form<uint64_t>(Payload::index, [](auto check) {
    for (const uint32_t n : {0u, 1u, 2u, 2047u, 2048u, 2049u, 4608u, 5000u})
      check({random_keys<uint64_t>(n, n), 27, 35});
  });
}

TEST_CASE("radix sort: both widths of keys with every payload") {
  for (const Payload payload : {Payload::none, Payload::words, Payload::index}) {
    CAPTURE(static_cast<int>(payload));
    for_each_form<uint32_t>(payload, [](auto check) { check({random_keys<uint32_t>(4200, 1)}); });
    for_each_form<uint64_t>(payload, [](auto check) { check({random_keys<uint64_t>(2100, 2), 8, 48}); });
  }
}

TEST_CASE("radix sort: kinds of keys") {
  constexpr uint32_t n = 2500;
  std::vector<uint32_t> rising(n), falling(n);
  for (uint32_t i = 0; i < n; ++i) rising[i] = 1000003 * i, falling[n - 1 - i] = rising[i];
  std::vector<uint32_t> top_set = random_keys<uint32_t>(n, 4);
  for (uint32_t& key : top_set) key |= 0x80000000u;
  for_each_form<uint32_t>(Payload::words, [&](auto check) {
    check({random_keys<uint32_t>(n, 3, 0x01000001)});  // four distinct: the order of equals shows
    check({std::vector<uint32_t>(n, 0xDEADBEEF)});
    check({rising});
    check({falling});
    check({top_set});
  });
}

TEST_CASE("radix sort: digits that are the same in all keys are skipped, whether odd or even many others move") {
  for (const Payload payload : {Payload::words, Payload::index}) {
    CAPTURE(static_cast<int>(payload));
    for_each_form<uint32_t>(payload, [](auto check) {
      for (const uint32_t mask : {0u, 0xFF00u, 0xFF0000FFu, 0xFFFF00FFu}) {
        CAPTURE(mask);
        std::vector<uint32_t> keys = random_keys<uint32_t>(1500, 5, mask);
        for (uint32_t& key : keys) key |= 0x12345678u & ~mask;
        check({keys});
      }
    });
  }
}

TEST_CASE("radix sort: only the bits of the range order") {
  for_each_form<uint32_t>(Payload::index, [](auto check) {
    for (const auto& [first, end] : {std::pair{9u, 9u}, {32u, 32u}, {31u, 32u}, {3u, 20u}})
      check({random_keys<uint32_t>(1100, 6), first, end});
  });
  for_each_form<uint64_t>(Payload::words, [](auto check) {
    for (const auto& [first, end] : {std::pair{64u, 64u}, {63u, 64u}, {29u, 40u}})
      check({random_keys<uint64_t>(1100, 7), first, end});
  });
}

namespace {

// Small tiles, of which a few thousand keys fill many. Groups of 128 have fewer items than digits.
RadixTuning small_tiles(uint32_t items = 128, uint32_t item_keys = 4, RadixRanks ranks = RadixRanks::masks) {
  RadixTuning tuning;
  tuning.items = items;
  tuning.item_keys = item_keys;
  tuning.ranks = ranks;
  tuning.columns = 8;
  return tuning;
}

// Sorts keys for which the order of equal ones shows, keys in order, and keys in the opposite order.
void check_many_tiles(const RadixTuning& tuning) {
  const uint32_t n = as_many(9, 3) * 512 + 100, kinds = as_many(4, 2);
  std::vector<uint32_t> rising(n), falling(n);
  std::iota(rising.begin(), rising.end(), 0u);
  std::iota(falling.rbegin(), falling.rend(), 0u);
  RadixSort<uint32_t> sort(context(), Payload::words, tuning);
  const std::array all{random_keys<uint32_t>(n, 3, 0x01000101), falling, random_keys<uint32_t>(n, 1), rising};
  for (const auto& keys : std::span(all).first(kinds)) check_sort<uint32_t>(sort, Payload::words, {keys, 0, 28});
}

}  // namespace

TEST_CASE("radix sort: groups and tiles of other sizes and every way to rank") {
  struct Sizes {
    uint32_t items, item_keys;
    RadixRanks ranks;
  };
  // votes and match are masks on devices other than NVIDIA's GPUs
  for (const auto& [items, item_keys, ranks] :
       {Sizes{128, 4, RadixRanks::columns}, Sizes{128, 4, RadixRanks::masks}, Sizes{384, 1, RadixRanks::masks},
        Sizes{256, 3, RadixRanks::votes}, Sizes{128, 5, RadixRanks::match}}) {
    CAPTURE(static_cast<int>(ranks));
    CAPTURE(items);
    const RadixTuning tuning = small_tiles(items, item_keys, ranks);
    RadixSort<uint32_t> sort(context(), Payload::words, tuning);
    const uint32_t tile = tuning.tile();
    for (const uint32_t n : {2u, tile - 1, tile, tile + 1, 3 * tile + 5})
      check_sort<uint32_t>(sort, Payload::words, {random_keys<uint32_t>(n, n), 3, 16});
    check_sort<uint32_t>(sort, Payload::words, {std::vector<uint32_t>(1100, 7)});
  }
}

TEST_CASE("radix sort: values that are read late, and several launches for a pass") {
  for (const bool wide : {false, true})
    for (const uint32_t most_tiles : {1u, 2u, 3u, 100u}) {
      CAPTURE(most_tiles);
      RadixTuning tuning = small_tiles();
      tuning.late_values = wide;
      tuning.most_keys = most_tiles * tuning.tile();
      if (wide) {
        RadixSort<uint64_t> sort(context(), Payload::index, tuning);
        check_sort<uint64_t>(sort, Payload::index, {random_keys<uint64_t>(as_many(7, 3) * 512, 2), 30, 48});
      } else {
        RadixSort<uint32_t> sort(context(), Payload::words, tuning);
        check_sort<uint32_t>(sort, Payload::words, {random_keys<uint32_t>(as_many(4000, 1700), 1), 3, 27});
      }
    }
}

TEST_CASE("radix sort: a group that finds nothing published counts earlier tiles itself with the same result") {
  struct Faults {
    uint32_t looks, silent, window, items;
  };
  for (const auto& [looks, silent, window, items] :
       {Faults{0, 0, 4, 128}, Faults{3, 1, 1, 256}, Faults{2, 2, 4, 128}}) {
    CAPTURE(looks);
    CAPTURE(silent);
    RadixTuning tuning = small_tiles(items, 512 / items);
    tuning.looks = looks;
    tuning.silent = silent;
    tuning.window = window;
    tuning.tickets = silent != 2;
    check_many_tiles(tuning);
    tuning.most_keys = 3 * tuning.tile();
    check_many_tiles(tuning);
  }
}

TEST_CASE("radix sort: floats by their ordered bits, zeros and NaN included") {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> floats{nan, -nan, infinity, -infinity, 0.0f, -0.0f, 1e-45f, -1e-45f, 1.0f, -1.0f, 3e38f, -3e38f};
  Random random(8);
  while (floats.size() < 1200) floats.push_back(static_cast<float>(random.between(-100, 100)));
  for (size_t i = 0; i < 12; ++i) floats.push_back(floats[i]);  // twice, far apart
  std::vector<uint32_t> keys;
  for (const float x : floats) keys.push_back(ordered_bits(x));
  std::vector<uint32_t> expected(floats.size());
  std::iota(expected.begin(), expected.end(), 0u);
  std::stable_sort(expected.begin(), expected.end(), [&](uint32_t a, uint32_t b) {
    return std::strong_order(floats[a], floats[b]) < 0;  // totalOrder of IEEE 754
  });
  const auto n = static_cast<uint32_t>(keys.size());
  for (const NamedForm& form : sort_forms) {
    CAPTURE(form.name);
    RadixSort<uint32_t> sort(context(), Payload::index, form.form);
    gpu::Buffer<uint32_t> device_keys = context().buffer(keys, "keys");
    gpu::Buffer<uint32_t> order = context().buffer<uint32_t>(n, "order");
    gpu::Buffer<uint32_t> temporary = context().buffer<uint32_t>(sort.temporary_words(n), "temporary");
    sort(device_keys, order, n, temporary);
    CHECK(equal(order.read(), expected));
  }
}

TEST_CASE("radix sort: wrong arguments are refused with their numbers") {
  RadixSort<uint32_t> sort(context(), Payload::words);
  const size_t words = sort.temporary_words(10);
  gpu::Buffer<uint32_t> keys = context().buffer<uint32_t>(10, "keys"), values = context().buffer<uint32_t>(9, "values");
  gpu::Buffer<uint32_t> enough = context().buffer<uint32_t>(words, "temporary");
  gpu::Buffer<uint32_t> short_by_one = context().buffer<uint32_t>(words - 1, "temporary");
  CHECK_THROWS_WITH_AS(sort(keys, values, 10, enough),
                       "radix_sort: values has 9 elements, 10 are needed to sort 10 keys", std::invalid_argument);
  CHECK_THROWS_WITH_AS(sort(values, keys, 10, enough), "radix_sort: keys has 9 elements, 10 are needed to sort 10 keys",
                       std::invalid_argument);
  const std::string temporary = "radix_sort: temporary has " + std::to_string(words - 1) + " elements, " +
                                std::to_string(words) + " are needed to sort 10 keys";
  CHECK_THROWS_WITH_AS(sort(keys, keys, 10, short_by_one), temporary.c_str(), std::invalid_argument);
  CHECK_THROWS_WITH_AS(sort(keys, keys, 10, enough, 0, 33), "radix_sort: bits 0 to 33 are no range of keys of 32 bits",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(sort(keys, keys, 10, enough, 8, 7), "radix_sort: bits 8 to 7 are no range of keys of 32 bits",
                       std::invalid_argument);
  CHECK_THROWS_AS(sort(keys, 10, enough), std::logic_error);
}
