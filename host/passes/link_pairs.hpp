// SPDX-License-Identifier: Apache-2.0
// Links as pairs, for passes that make a row for each.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "passes/radio_ends.hpp"

namespace wavetracer {

// The transmitter and receiver of each link.
inline std::vector<uint32_t> link_pairs(const RadioEnds& ends) {
  const uint32_t groups = ends.receiver_capacity / 16;
  std::vector<uint32_t> out;
  for (uint32_t tx = 0; tx < ends.transmitter_count; ++tx)
    for (uint32_t group = 0; group < groups; ++group)
      for (uint32_t word = ends.link_words[size_t{tx} * groups + group]; word; word &= word - 1)
        out.insert(out.end(), {tx, 16 * group + static_cast<uint32_t>(std::countr_zero(word))});
  return out;
}

}  // namespace wavetracer
