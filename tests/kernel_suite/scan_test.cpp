// SPDX-License-Identifier: Apache-2.0
// Tests of the public Scan and Compact against std::exclusive_scan and a loop.
#include "wavetracer/kernels/scan.hpp"

#include <doctest/doctest.h>

#include <numeric>

#include "contains.hpp"
#include "gpu/temporary.hpp"
#include "kernel_suite/user.hpp"
#include "wavetracer/kernels/compact.hpp"

using namespace wavetracer::test;
namespace kernels = wavetracer::kernels;

TEST_CASE("exclusive prefix sums are those of std::exclusive_scan, and the total stays on the device") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  kernels::Scan scan(context);
  for (const size_t n : {0, 1, 5, 1000, 10000}) {
    INFO("n ", n);
    const std::vector<uint32_t> data = random_keys<uint32_t>(n + 2, n);
    const auto words = context.buffer<uint32_t>(n + 2), total = context.buffer<uint32_t>(2);
    words.write(data);
    total.write(std::vector<uint32_t>{77, 78});
    scan(words, n, total);
    std::vector<uint32_t> expected = data;
    std::exclusive_scan(data.begin(), data.begin() + n, expected.begin(), 0u);
    CHECK(words.read() == expected);
    CHECK(total.read() == std::vector<uint32_t>{std::accumulate(data.begin(), data.begin() + n, 0u), 78});
    words.write(data);
    scan(words, n);
    CHECK(words.read() == expected);
  }
  const auto words = context.buffer<uint32_t>(4);
  CHECK(contains(message_of<kernels::Error>([&] { scan(words, 5); }), "Scan: words: the buffer has 16 bytes"));
  CHECK(contains(message_of<kernels::Error>([&] { scan(words, 4, kernels::Buffer<uint32_t>()); }), "Scan: total"));
}

TEST_CASE("the indices of words that are something come in order") {
  const User user;
  const kernels::Context context(user.context, user.device, user.queue);
  kernels::Compact compact(context);
  for (const size_t n : {0, 1, 31, 1000, 20000}) {
    INFO("n ", n);
    std::vector<uint32_t> data = random_keys<uint32_t>(n + 1, n), expected;
    for (size_t i = 0; i < n; ++i)
      if (data[i] % 3 == 0) data[i] = kernels::nothing;
    for (uint32_t i = 0; i < n; ++i)
      if (data[i] != kernels::nothing) expected.push_back(i);
    const auto words = context.buffer<uint32_t>(n + 1), indices = context.buffer<uint32_t>(n + 1),
               total = context.buffer<uint32_t>(1);
    words.write(data);
    indices.write(std::vector<uint32_t>(n + 1, 123456789));
    total.write(std::vector<uint32_t>{55});
    compact(words, n, indices, total);
    CHECK(total.read() == std::vector<uint32_t>{static_cast<uint32_t>(expected.size())});
    expected.resize(n + 1, 123456789);
    CHECK(indices.read() == expected);
  }
  const auto words = context.buffer<uint32_t>(8), few = context.buffer<uint32_t>(7);
  CHECK(contains(message_of<kernels::Error>([&] { compact(words, 8, few, few); }), "Compact: indices"));
}
