// SPDX-License-Identifier: Apache-2.0
// bitonic_sort against std::stable_sort: both forms, every payload, lengths around powers of two and blocks. Blocks are
// small, so that a few hundred keys already need every launch.
#include "passes/bitonic_sort.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

enum class Keys { random, few, equal, sorted, reversed, extreme, ending };

template <class Key>
std::vector<Key> make_keys(Keys kind, uint32_t n) {
  Random random(n + 1);
  std::vector<Key> keys(n);
  for (uint32_t i = 0; i < n; ++i) {
    const Key word = static_cast<Key>((uint64_t{random.below(~0u)} << 32) * (sizeof(Key) / 8) | random.below(~0u));
    switch (kind) {
      case Keys::random:
        keys[i] = word;
        break;
      case Keys::few:
        keys[i] = word % 5;
        break;
      case Keys::equal:
        keys[i] = Key{1} << (8 * sizeof(Key) - 1);
        break;
      case Keys::sorted:
        keys[i] = i / 3;
        break;
      case Keys::reversed:
        keys[i] = static_cast<Key>(~Key{0} - i / 3);
        break;
      // The values are 0, the largest key and the top bit: the largest key is also the padding of vectors.
      case Keys::extreme:
        keys[i] = word % 3 == 0 ? 0 : word % 3 == 1 ? ~Key{0} : Key{1} << (8 * sizeof(Key) - 1);
        break;
      // The largest key appears here and there, and from a third of them on: the padding at the end of a block is not
      // sorted.
      case Keys::ending:
        keys[i] = i > n / 3 || word % 4 == 0 ? ~Key{0} : word % 7;
        break;
    }
  }
  return keys;
}

// Sorts n keys with values 1000, 1001, ...; three keys and values after them must not change.
template <class Key>
void check_sort(BitonicSort<Key>& sort, Payload payload, const std::vector<Key>& unsorted) {
  const auto n = static_cast<uint32_t>(unsorted.size());
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return unsorted[a] < unsorted[b]; });

  std::vector<Key> keys = unsorted, expected_keys;
  std::vector<uint32_t> values(n + 3), expected_values;
  std::iota(values.begin(), values.end(), 1000u);
  for (const uint32_t i : order) {
    expected_keys.push_back(unsorted[i]);
    expected_values.push_back(payload == Payload::index ? i : payload == Payload::words ? values[i] : 0);
  }
  if (payload == Payload::none) expected_values.assign(values.begin(), values.begin() + n);
  for (uint32_t i = 0; i < 3; ++i) {
    keys.push_back(i);  // small keys would be drawn forward
    expected_keys.push_back(i);
    expected_values.push_back(values[n + i]);
  }
  gpu::Buffer<Key> key_buffer = context().buffer(keys, "keys");
  gpu::Buffer<uint32_t> value_buffer = context().buffer(values, "values");
  auto temporary = context().template buffer<uint32_t>(std::max<size_t>(1, sort.temporary_words(n)), "temporary");
  if (payload == Payload::none) {
    sort(key_buffer, n, temporary);
  } else {
    sort(key_buffer, value_buffer, n, temporary);
  }
  CHECK(key_buffer.read() == expected_keys);
  CHECK(value_buffer.read() == expected_values);
}

template <class Key>
void check_form(typename BitonicSort<Key>::Form form) {
  for (const Payload payload : {Payload::none, Payload::words, Payload::index}) {
    CAPTURE(static_cast<int>(payload));
    BitonicSort<Key> sort(context(), payload, form, 64);
    REQUIRE(sort.block() == 64);
    for (const uint32_t n : {0u, 1u, 2u, 3u, 15u, 17u, 31u, 33u, 63u, 64u, 65u, 127u, 129u, 300u}) {
      CAPTURE(n);
      check_sort(sort, payload, make_keys<Key>(Keys::random, n));
    }
    for (const Keys kind : {Keys::few, Keys::equal, Keys::sorted, Keys::reversed, Keys::extreme, Keys::ending})
      for (const uint32_t n : {50u, 200u}) {
        CAPTURE(static_cast<int>(kind));
        CAPTURE(n);
        check_sort(sort, payload, make_keys<Key>(kind, n));
      }
  }
}

}  // namespace

TEST_CASE("a bitonic sort by work-groups is std::stable_sort") {
  check_form<uint32_t>(BitonicSort<uint32_t>::Form::groups);
  check_form<uint64_t>(BitonicSort<uint64_t>::Form::groups);
}

TEST_CASE("a bitonic sort by vectors is std::stable_sort") {
  check_form<uint32_t>(BitonicSort<uint32_t>::Form::vectors);
  check_form<uint64_t>(BitonicSort<uint64_t>::Form::vectors);
}

TEST_CASE("the device's own bitonic sort, at the size of its block and beside it") {
  BitonicSort<uint32_t> sort(context(), Payload::words);
  for (const uint32_t n : {sort.block() - 1, sort.block(), sort.block() + 1}) {
    CAPTURE(n);
    check_sort(sort, Payload::words, make_keys<uint32_t>(Keys::few, n));
  }
}

TEST_CASE("a bitonic sort refuses buffers that are too short, and values that are missing") {
  BitonicSort<uint32_t> sort(context(), Payload::words, BitonicSort<uint32_t>::Form::device, 16);
  auto keys = context().buffer<uint32_t>(40, "keys"), values = context().buffer<uint32_t>(40, "values");
  auto temporary = context().buffer<uint32_t>(79, "temporary");
  CHECK(sort.temporary_words(16) == 0);
  CHECK(sort.temporary_words(40) == 80);
  CHECK_THROWS_WITH_AS(sort(keys, values, 40, temporary),
                       "bitonic_sort: temporary memory has 79 elements, 80 are needed", std::invalid_argument);
  CHECK_THROWS_WITH_AS(sort(keys, values, 41, temporary), "bitonic_sort: values has 40 elements, 41 are needed",
                       std::invalid_argument);
  CHECK_THROWS_AS(sort(keys, 10, temporary), std::invalid_argument);
  CHECK_THROWS_AS(BitonicSort<uint32_t>(context(), Payload::none, BitonicSort<uint32_t>::Form::device, 8),
                  std::invalid_argument);
}
