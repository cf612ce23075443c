// SPDX-License-Identifier: Apache-2.0
// Tests of the public Sort against std::stable_sort: widths, payloads, methods and ranges of bits.
// Passes have tests of their own; these show that each option arrives at its pass.
#include "wavetracer/kernels/sort.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "contains.hpp"
#include "gpu/temporary.hpp"
#include "kernel_suite/user.hpp"

using namespace wavetracer::test;
namespace kernels = wavetracer::kernels;
using kernels::Payload;
using kernels::SortMethod;

namespace {

// Sorts on the device and on the host, and compares keys and payload.
template <class Key>
void compare(const kernels::Context& context, const kernels::SortOptions& options, size_t n,
             kernels::BitRange bits = {}) {
  INFO("keys of ", options.key_bits, " bits, payload ", static_cast<int>(options.payload), ", method ",
       static_cast<int>(options.method), ", n ", n, ", bits ", bits.first_bit, " to ", bits.end_bit);
  std::vector<Key> keys = random_keys<Key>(n + 3, n);
  for (size_t i = 0; i < n; i += 2) keys[i] %= 16;  // some are equal
  std::vector<uint32_t> values = random_keys<uint32_t>(n + 3, 7);
  const auto key_buffer = context.buffer<Key>(n + 3);
  const auto value_buffer = context.buffer<uint32_t>(n + 3);
  key_buffer.write(keys);
  value_buffer.write(values);
  kernels::Sort sort(context, options);
  if (options.payload == Payload::none)
    sort(key_buffer, n, bits);
  else
    sort(key_buffer, value_buffer, n, bits);

  const unsigned end_bit = bits.end_bit == 0 ? options.key_bits : bits.end_bit, width = end_bit - bits.first_bit;
  const Key mask = width == options.key_bits ? ~Key{0} : static_cast<Key>((Key{1} << width) - 1);
  std::vector<uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return (keys[a] >> bits.first_bit & mask) < (keys[b] >> bits.first_bit & mask);
  });
  std::vector<Key> sorted_keys = keys;
  std::vector<uint32_t> sorted_values = values;
  for (size_t i = 0; i < n; ++i) {
    sorted_keys[i] = keys[order[i]];
    if (options.payload == Payload::words) sorted_values[i] = values[order[i]];
    if (options.payload == Payload::index) sorted_values[i] = order[i];
  }
  CHECK(key_buffer.read() == sorted_keys);
  CHECK(value_buffer.read() == sorted_values);
}

}  // namespace

TEST_CASE("keys of both widths, all payloads and methods are sorted as by std::stable_sort") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  for (const Payload payload : {Payload::none, Payload::words, Payload::index}) {
    for (const SortMethod method : {SortMethod::automatic, SortMethod::radix, SortMethod::bitonic}) {
      for (const size_t n : {0, 1, 2, 100, 9000}) {
        compare<uint32_t>(context, {.key_bits = 32, .payload = payload, .method = method}, n);
        compare<uint64_t>(context, {.key_bits = 64, .payload = payload, .method = method}, n);
      }
    }
  }
}

TEST_CASE("ranges of bits are sorted by radix and by the automatic choice, stable in the rest") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  for (const SortMethod method : {SortMethod::automatic, SortMethod::radix}) {
    compare<uint32_t>(context, {.key_bits = 32, .payload = Payload::words, .method = method}, 500, {4, 13});
    compare<uint32_t>(context, {.key_bits = 32, .payload = Payload::index, .method = method}, 500, {.end_bit = 7});
    compare<uint64_t>(context, {.key_bits = 64, .payload = Payload::words, .method = method}, 500, {33, 0});
  }
}

TEST_CASE("wrong options and ranges are refused before anything is enqueued") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  const auto refusal = [](const auto& function) { return message_of<kernels::Error>(function); };
  CHECK(contains(refusal([&] { kernels::Sort(context, {.key_bits = 16}); }), "keys have 32 or 64 bits"));
  const std::vector<uint32_t> data = random_keys<uint32_t>(64);
  const auto keys = context.buffer<uint32_t>(64), values = context.buffer<uint32_t>(64);
  keys.write(data);
  kernels::Sort radix(context, {.method = SortMethod::radix}), network(context, {.method = SortMethod::bitonic});
  CHECK(contains(refusal([&] { radix(keys, 64, {9, 4}); }), "bits 9 to 4 are no range"));
  CHECK(contains(refusal([&] { radix(keys, 64, {0, 33}); }), "bits 0 to 33 are no range"));
  CHECK(contains(refusal([&] { network(keys, 64, {0, 8}); }), "the bitonic method sorts by all bits"));
  CHECK(contains(refusal([&] { radix(keys, values, 64); }), "it was made for Payload::none"));
  CHECK(contains(refusal([&] { radix(context.buffer<uint64_t>(8), 8); }), "it was made for keys of 32 bits"));
  CHECK(contains(refusal([&] { radix(keys, size_t{1} << 32); }), "at most 4294967295"));
  kernels::Sort pairs(context, {.payload = Payload::words});
  CHECK(contains(refusal([&] { pairs(keys, 64); }), "no values were given"));
  CHECK(keys.read() == data);
}

TEST_CASE("temporary memory is the object's own or the caller's") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  std::vector<uint32_t> data = random_keys<uint32_t>(3000);
  const auto keys = context.buffer<uint32_t>(data.size());
  keys.write(data);
  kernels::Sort sort(context, {.method = SortMethod::radix});
  CHECK(sort.temporary_words(data.size()) >= data.size());
  const auto room = context.buffer<uint32_t>(sort.temporary_words(data.size()));
  room.write(std::vector<uint32_t>(room.size(), 0xabcdef01u));
  sort.use_temporary(room);
  sort(keys, data.size());
  CHECK(room.read() != std::vector<uint32_t>(room.size(), 0xabcdef01u));  // it is what the sort used
  std::sort(data.begin(), data.end());
  CHECK(keys.read() == data);
  sort.use_temporary(context.buffer<uint32_t>(10));
  CHECK(contains(message_of<kernels::Error>([&] { sort(keys, data.size()); }),
                 "10 words of temporary memory were given"));
  sort.use_temporary({});
  sort(keys, data.size());
  CHECK(keys.read() == data);
  CHECK(kernels::Sort(context, {}).block() >= 16);
}
