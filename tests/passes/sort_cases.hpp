// SPDX-License-Identifier: Apache-2.0
// Helpers of the tests of the radix sort: its forms, keys of a kind, and a check against std::stable_sort. Words after
// the keys, the values and the temporary memory must not change.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "passes/on_device.hpp"
#include "passes/radix_sort.hpp"
#include "passes/triangles.hpp"

namespace wavetracer::test {

struct NamedForm {
  SortForm form;
  const char* name;
};
inline constexpr NamedForm sort_forms[] = {
    {SortForm::groups, "groups"}, {SortForm::chunks, "chunks"}, {SortForm::lines, "lines"}};

template <class Key>
std::vector<Key> random_keys(size_t count, uint32_t seed, Key mask = ~Key{0}) {
  Random random(seed);
  const auto word = [&] { return random.below(1u << 16); };
  std::vector<Key> keys(count);
  for (Key& key : keys) {
    for (size_t part = 0; part < sizeof(Key) / 2; ++part) key = key << 16 | word();
    key &= mask;
  }
  return keys;
}

template <class Key>
struct SortCase {
  std::vector<Key> keys;
  unsigned first_bit = 0, end_bit = 8 * sizeof(Key);
};

// The order that a stable sort gives: order[i] is where the i-th smallest key stood.
template <class Key>
std::vector<uint32_t> stable_order(const SortCase<Key>& c) {
  const auto digits = [&](uint32_t i) {
    const Key low = c.end_bit == 8 * sizeof(Key) ? c.keys[i] : c.keys[i] & ((Key{1} << c.end_bit) - 1);
    return c.first_bit == 8 * sizeof(Key) ? Key{0} : low >> c.first_bit;
  };
  std::vector<uint32_t> order(c.keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return digits(a) < digits(b); });
  return order;
}

template <class T>
std::vector<T> permuted(const std::vector<T>& data, const std::vector<uint32_t>& order, const std::vector<T>& behind) {
  std::vector<T> out;
  for (const uint32_t i : order) out.push_back(data[i]);
  out.insert(out.end(), behind.begin(), behind.end());
  return out;
}

template <class T>
gpu::Buffer<T> upload_with(std::vector<T> data, const std::vector<T>& behind) {
  data.insert(data.end(), behind.begin(), behind.end());
  return context().buffer(data, "sort test");
}

// A failed check of it prints one line, not thousands of keys.
template <class T>
bool equal(const std::vector<T>& a, const std::vector<T>& b) {
  return a == b;
}

template <class Key>
void check_sort(RadixSort<Key>& sort, Payload payload, const SortCase<Key>& c) {
  const auto n = static_cast<uint32_t>(c.keys.size());
  CAPTURE(n);
  CAPTURE(c.first_bit);
  CAPTURE(c.end_bit);
  const std::vector<Key> behind_keys{1, 2, 3};
  const std::vector<uint32_t> behind{7, 8, 9};
  const std::vector<uint32_t> values = random_keys<uint32_t>(n, 99);
  gpu::Buffer<Key> sorted_keys = upload_with(c.keys, behind_keys);
  gpu::Buffer<uint32_t> sorted_values = upload_with(values, behind);
  const size_t words = sort.temporary_words(n);
  gpu::Buffer<uint32_t> temporary = upload_with(std::vector<uint32_t>(words, 0xA5A5A5A5u), behind);
  if (payload == Payload::none)
    sort(sorted_keys, n, temporary, c.first_bit, c.end_bit);
  else
    sort(sorted_keys, sorted_values, n, temporary, c.first_bit, c.end_bit);
  const std::vector<uint32_t> order = stable_order(c);
  CHECK(equal(sorted_keys.read(), permuted(c.keys, order, behind_keys)));
  if (payload == Payload::words) CHECK(equal(sorted_values.read(), permuted(values, order, behind)));
  if (payload == Payload::index) {
    std::vector<uint32_t> expected = order;
    expected.insert(expected.end(), behind.begin(), behind.end());
    CHECK(equal(sorted_values.read(), expected));
  }
  CHECK(equal(temporary.read(words, behind.size()), behind));
}

}  // namespace wavetracer::test
