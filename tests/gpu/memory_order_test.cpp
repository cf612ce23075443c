// SPDX-License-Identifier: Apache-2.0
// Tests of kernels/lib/memory_order.clh: what work-items do at once is counted on the host.
// Small enough for Oclgrind; on a real device the same kernels run with more work-items.
#include <doctest/doctest.h>
#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include "gpu/gpu.hpp"

using namespace wavetracer;

namespace {

constexpr uint32_t group = 64;

// Oclgrind interprets some million instructions a second. On other devices a launch must last long enough for all cores
// to take part in it.
uint32_t scaled(const gpu::Context& context, uint32_t count) {
  return context.info().platform == "Oclgrind" ? std::min(count, 2048u) : count;
}

}  // namespace

TEST_CASE("fetch-add hands out every place once") {
  gpu::Context context;
  const uint32_t count = scaled(context, 1u << 22);
  auto counter = context.buffer(std::vector<uint32_t>{0}, "counter");
  auto places = context.buffer<uint32_t>(count, "places");
  context.kernel("probe_memory_order", "take_places")({count, group}, Stage::transfer, counter, places, count);
  CHECK(counter.read_one(0) == count);
  std::vector<bool> taken(count);
  size_t wrong = 0;
  for (const uint32_t place : places.read()) {
    wrong += place >= count || taken[place];
    if (place < count) taken[place] = true;
  }
  CHECK(wrong == 0);
}

TEST_CASE("a set claimed by 64-bit compare-and-swap inserts each word once") {
  gpu::Context context;
  // There are few words at any time, so that work-items compete for the same slots.
  const uint32_t count = scaled(context, 1u << 21), distinct = count / 4, slots = count / 2, window = 64;
  std::mt19937_64 random(1);
  std::vector<uint64_t> universe(distinct), words(count);
  for (uint64_t& word : universe) word = random() | 1;
  for (uint32_t i = 0; i < count; ++i)
    words[i] = universe[(i % (count / 4) / window * window + random() % window) % distinct];
  const std::set<uint64_t> expected(words.begin(), words.end());

  auto input = context.buffer(words, "words");
  auto table = context.buffer<uint64_t>(slots, "table");
  auto inserted = context.buffer<uint32_t>(1, "inserted");
  auto winners = context.buffer<uint32_t>(slots, "winners");
  auto lost = context.buffer<uint32_t>(1, "lost");
  context.fill(table, 0);
  for (auto* buffer : {&inserted, &winners, &lost}) context.fill(*buffer, 0);
  context.kernel("probe_memory_order", "insert_words")({count, group}, Stage::transfer, input, count, table, slots - 1,
                                                       inserted, winners, lost);

  CHECK(lost.read_one(0) == 0);
  CHECK(inserted.read_one(0) == expected.size());
  const std::vector<uint64_t> after = table.read();
  const std::vector<uint32_t> wins = winners.read();
  std::multiset<uint64_t> kept;
  size_t wrong = 0;
  for (uint32_t slot = 0; slot < slots; ++slot) {
    wrong += wins[slot] != (after[slot] != 0 ? 1u : 0u);
    if (after[slot] != 0) kept.insert(after[slot]);
  }
  CHECK(wrong == 0);
  CHECK(std::equal(kept.begin(), kept.end(), expected.begin(), expected.end()));
}

TEST_CASE("the lowest of many words stays, and one work-item is the first") {
  gpu::Context context;
  const uint32_t count = scaled(context, 1u << 20), slots = 37;
  std::mt19937 random(2);
  std::vector<uint32_t> words(count), lowest(slots, 0xFFFFFFFFu);
  for (uint32_t i = 0; i < count; ++i) {
    words[i] = static_cast<uint32_t>(random());
    lowest[i % slots] = std::min(lowest[i % slots], words[i]);
  }
  auto table = context.buffer(std::vector<uint32_t>(slots, 0xFFFFFFFFu), "table");
  auto first = context.buffer(std::vector<uint32_t>(slots, 0xFFFFFFFFu), "first");
  auto firsts = context.buffer(std::vector<uint32_t>(1), "firsts");
  context.kernel("probe_memory_order", "keep_lowest")({count, group}, Stage::transfer, context.buffer(words, "words"),
                                                      count, table, slots, first, firsts);
  CHECK(table.read() == lowest);
  CHECK(firsts.read_one(0) == slots);
  const std::vector<uint32_t> came = first.read();
  for (uint32_t slot = 0; slot < slots; ++slot) CHECK(came[slot] % slots == slot);
}

TEST_CASE("a full set loses words and says how many") {
  gpu::Context context;
  const uint32_t count = 100, slots = 64;
  std::vector<uint64_t> words(count);
  std::iota(words.begin(), words.end(), uint64_t{1});
  auto input = context.buffer(words, "words");
  auto table = context.buffer(std::vector<uint64_t>(slots), "table");
  auto inserted = context.buffer(std::vector<uint32_t>(1), "inserted");
  auto winners = context.buffer(std::vector<uint32_t>(slots), "winners");
  auto lost = context.buffer(std::vector<uint32_t>(1), "lost");
  context.kernel("probe_memory_order", "insert_words")({count, group}, Stage::transfer, input, count, table, slots - 1,
                                                       inserted, winners, lost);
  CHECK(inserted.read_one(0) == slots);
  CHECK(lost.read_one(0) == count - slots);
}

TEST_CASE("what is published by release and acquire is never torn") {
  gpu::Context context;
  const uint32_t pairs = scaled(context, 1u << 21) / 2;
  auto payload = context.buffer<uint32_t>(2 * size_t{pairs}, "payload");
  auto flags = context.buffer<uint32_t>(pairs, "flags");
  auto seen = context.buffer<uint32_t>(pairs, "seen");
  for (const uint32_t distance : {1u, 4u, 16u}) {
    CAPTURE(distance);
    for (auto* buffer : {&payload, &flags, &seen}) context.fill(*buffer, 0);
    context.kernel("probe_memory_order", "publish")({2 * size_t{pairs}, group}, Stage::transfer, payload, flags, seen,
                                                    pairs, distance);
    const std::vector<uint32_t> states = seen.read(), published = flags.read();
    CHECK(std::count(states.begin(), states.end(), 2u) == 0);
    CHECK(std::count(published.begin(), published.end(), 1u) == pairs);
  }
}

TEST_CASE("one of two claims a word by 32-bit compare-and-swap, and the fence orders what it writes") {
  gpu::Context context;
  const uint32_t pairs = scaled(context, 1u << 21) / 2;
  auto owners = context.buffer<uint32_t>(pairs, "owners");
  auto words = context.buffer<uint64_t>(pairs, "words");
  auto flags = context.buffer<uint32_t>(pairs, "flags");
  auto wins = context.buffer<uint32_t>(pairs, "wins");
  for (const uint32_t distance : {1u, 4u, 16u}) {
    CAPTURE(distance);
    for (auto* buffer : {&owners, &flags, &wins}) context.fill(*buffer, 0);
    context.fill(words, 0);
    context.kernel("probe_memory_order", "claim")({2 * size_t{pairs}, group}, Stage::transfer, owners, words, flags,
                                                  wins, pairs, distance);
    const std::vector<uint32_t> owner = owners.read(), won = wins.read();
    const std::vector<uint64_t> word = words.read();
    size_t wrong = 0;
    for (uint32_t i = 0; i < pairs; ++i) {
      // Pair i belongs to one item of each of two work-groups `distance` apart; owners count from 1.
      const uint32_t low_group = i / group / distance * 2 * distance + i / group % distance;
      const uint32_t low = low_group * group + i % group + 1, high = low + distance * group;
      wrong += won[i] != 1 || (owner[i] != low && owner[i] != high) || word[i] != owner[i];
    }
    CHECK(wrong == 0);
  }
}
