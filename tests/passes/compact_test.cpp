// SPDX-License-Identifier: Apache-2.0
// compact: counts of blocks and lists of indices against a loop over the words, in both forms.
// Words lie inside a larger buffer, and some are floats that compare equal to nothing (NaN) but are not WT_NONE.
#include "passes/compact.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <stdexcept>
#include <vector>

#include "passes/scan.hpp"
#include "passes/triangles.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

constexpr uint32_t untouched = 77;

// One word of `period` is live; period 1: all, 0: none.
void check_compact(Compact& compact, Scan& scan, uint32_t block, size_t first, uint32_t count, uint32_t period) {
  Random random(count + period);
  const uint32_t blocks = (count + block - 1) / block;
  std::vector<float> words(first + count + 5, 1.0f);  // values on both sides would be live, but are not read
  std::vector<uint32_t> expected_counts(blocks + 3, untouched), expected_indices;
  for (uint32_t b = 0; b < blocks; ++b) expected_counts[b] = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const bool lives = period != 0 && random.below(period) == 0;
    words[first + i] = std::bit_cast<float>(lives ? (i % 2 == 0 ? 0xFFFFFFFEu : i) : WT_NONE);
    if (!lives) continue;
    ++expected_counts[i / block];
    expected_indices.push_back(i);
  }
  const gpu::Buffer<float> buffer = context().buffer(words, "words");
  gpu::Buffer<uint32_t> counts = context().buffer(std::vector<uint32_t>(blocks + 3, untouched), "block counts");
  compact.count_blocks(buffer, first, count, counts);
  REQUIRE(counts.read() == expected_counts);

  const uint32_t total = scan(counts, blocks);
  REQUIRE(total == expected_indices.size());
  gpu::Buffer<uint32_t> indices = context().buffer(std::vector<uint32_t>(total + 3, untouched), "indices");
  compact(buffer, first, count, counts, indices);
  expected_indices.resize(total + 3, untouched);
  CHECK(indices.read() == expected_indices);
}

}  // namespace

TEST_CASE("compaction keeps the indices of the words that live, in order") {
  struct Case {
    Compact::Form form;
    uint32_t block;
  };
  Scan scan(context());
  for (const auto& [form, block] : {Case{Compact::Form::items, 16}, Case{Compact::Form::groups, 128}}) {
    CAPTURE(block);
    Compact compact(context(), block, form);
    for (const uint32_t count : {0u, 1u, 2u, block - 1, block, block + 1, 2 * block + 7, 1030u}) {
      CAPTURE(count);
      for (const uint32_t period : {0u, 1u, 3u}) check_compact(compact, scan, block, 9, count, period);
    }
    check_compact(compact, scan, block, 0, 300, 2);
  }
}

TEST_CASE("a compaction refuses what lies outside its buffers, and blocks that no work-group can have") {
  Compact compact(context(), 16, Compact::Form::items);
  const auto words = context().buffer<float>(40, "words");
  auto counts = context().buffer<uint32_t>(2, "counts");
  CHECK_THROWS_WITH_AS(compact.count_blocks(words, 10, 31, counts), "compact: words 10 to 41 of 40",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(compact.count_blocks(words, 0, 33, counts), "compact: 3 blocks in a buffer of 2",
                       std::invalid_argument);
  CHECK_THROWS_AS(Compact(context(), 48, Compact::Form::groups), std::invalid_argument);
  CHECK_THROWS_AS(Compact(context(), 1u << 20, Compact::Form::groups), std::invalid_argument);
  CHECK_THROWS_AS(Compact(context(), 0), std::invalid_argument);
}
