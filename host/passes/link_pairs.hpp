// SPDX-License-Identifier: Apache-2.0
// Links as pairs on the device, for passes that make rows for each.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "gpu/gpu.hpp"
#include "passes/radio_ends.hpp"

namespace wavetracer {

class LinkPairs {
 public:
  // name: of the buffer. Pairs are made anew if the links of `ends` differ from those before.
  void update(gpu::Context& context, const RadioEnds& ends, const char* name) {
    if (pairs_ && ends.link_words == words_) return;
    std::vector<uint32_t> pairs;
    const uint32_t groups = ends.receiver_capacity / 16;
    for (uint32_t tx = 0; tx < ends.transmitter_count; ++tx)
      for (uint32_t group = 0; group < groups; ++group)
        for (uint32_t word = ends.link_words[size_t{tx} * groups + group]; word; word &= word - 1)
          pairs.insert(pairs.end(), {tx, 16 * group + static_cast<uint32_t>(std::countr_zero(word))});
    if (!pairs.empty()) pairs_ = context.buffer(pairs, name);
    count_ = static_cast<uint32_t>(pairs.size() / 2);
    words_ = ends.link_words;
  }

  uint32_t count() const { return count_; }
  // The transmitter and receiver of each link, in this order. Empty if there has never been a link.
  const gpu::Buffer<uint32_t>& pairs() const { return pairs_; }

 private:
  std::vector<uint16_t> words_;  // those of pairs_
  gpu::Buffer<uint32_t> pairs_;
  uint32_t count_ = 0;
};

}  // namespace wavetracer
