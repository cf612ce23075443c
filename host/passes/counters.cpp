// SPDX-License-Identifier: Apache-2.0
// The expected length of a list is a quarter more than recent frames had, plus a thousand: work-items that find nothing
// to do cost less than a wait.
#include "passes/counters.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace wavetracer {
namespace {

// Keeps the larger count of each; earlier counts lose an eighth in each frame.
void keep_most(wt_counters& most, const wt_counters& now) {
  using Words = std::array<wt_uint, sizeof(wt_counters) / sizeof(wt_uint)>;
  auto words = std::bit_cast<Words>(most);
  const auto more = std::bit_cast<Words>(now);
  for (size_t i = 0; i < words.size(); ++i) words[i] = std::max(words[i] - words[i] / 8, more[i]);
  most = std::bit_cast<wt_counters>(words);
}

}  // namespace

uint32_t counter_word(Counters::Count count) {
  static const wt_counters counters{};
  const auto* const at = reinterpret_cast<const char*>(&(counters.*count));
  return static_cast<uint32_t>((at - reinterpret_cast<const char*>(&counters)) / sizeof(wt_uint));
}

Counters::Counters(gpu::Context& context) : context_(context), buffer_(context.buffer<wt_counters>(1, "counters")) {
  zero();
}

Counters::Zeroed Counters::zero() {
  buffer_.write(std::vector<wt_counters>{{}}, 0, Stage::sequences);
  return {};
}

void Counters::begin() {
  foreseen_.clear();
  in_parts_ = false;
}

void Counters::restart(Count count, uint32_t from, Stage stage) {
  context_.fill(buffer_, &from, sizeof from, counter_word(count) * sizeof(wt_uint), sizeof from, stage);
}

void Counters::restart_nodes(uint32_t count, Stage stage) {
  const wt_uint start[] = {count, 0};
  static_assert(offsetof(wt_counters, exchanged) == offsetof(wt_counters, nodes) + sizeof(wt_uint));
  context_.fill(buffer_, start, sizeof start, offsetof(wt_counters, nodes), sizeof start, stage);
}

void Counters::restart_ended(Stage stage) {
  const wt_uint none = 0;
  context_.fill(buffer_, &none, sizeof none, offsetof(wt_counters, ended), sizeof(wt_counters::ended), stage);
}

uint64_t Counters::expected(Count count) const { return uint64_t{most_.*count} + most_.*count / 4 + 1024; }

uint32_t Counters::length(Count count, size_t capacity, Stage stage) {
  if (!foresees_) return read(stage).*count;
  const auto most = static_cast<uint32_t>(std::min<uint64_t>(expected(count), capacity));
  foreseen_.emplace_back(count, most);
  return most;
}

bool Counters::settles(const wt_counters& now) {
  const bool fits = now.trie_overflow == 0 &&
                    std::ranges::all_of(foreseen_, [&](const auto& list) { return now.*list.first <= list.second; });
  keep_most(most_, now);
  if (foresees_ && !fits) return false;
  last_ = now;
  known_ = !in_parts_;
  return true;
}

}  // namespace wavetracer
