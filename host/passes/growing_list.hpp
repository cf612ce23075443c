// SPDX-License-Identifier: Apache-2.0
// Lists that kernels append to and count: the pass runs, the host asks for the length, and if the list was too small,
// makes it larger and runs the pass again. A kernel must count beyond the capacity, but write nothing there.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "passes/counters.hpp"

namespace wavetracer {

// run(): runs the kernel; length(): the number that it has counted; capacity(): that of the list now; grow(n): makes
// room for n elements, and lets the counter begin again with the elements that the list still holds. Returns the length
// of the list; if that is more than `most`, the list does not hold it.
template <class Run, class Length, class Capacity, class Grow>
uint32_t grow_until_filled(const Run& run, const Length& length, const Capacity& capacity, const Grow& grow,
                           uint32_t most = 0xFFFFFFFFu) {
  for (;;) {
    run();
    const uint32_t now = length();
    if (now <= capacity() || now > most) return now;
    grow(std::min<size_t>(size_t{now} + now / 4, most));
  }
}

// Makes lists of at most `most` elements from `items`: from `block` of them after the other, and from parts of a block
// where its list is too long. list(first, end): makes the list of these items, and returns its length. take(length):
// uses the list. again(first): is called before another list, which begins with this item. too_long(length): is called
// if the list of a single item is longer than `most`, and must throw.
template <class List, class Take, class Again, class TooLong>
void by_parts(uint32_t items, uint32_t block, uint32_t most, const List& list, const Take& take, const Again& again,
              const TooLong& too_long) {
  std::vector<std::pair<uint32_t, uint32_t>> left;  // in reverse order: the next one is last
  for (uint64_t at = 0; at == 0 || at < items; at += std::max(block, 1u))
    left.emplace_back(static_cast<uint32_t>(at), static_cast<uint32_t>(std::min<uint64_t>(items, at + block)));
  std::ranges::reverse(left);
  for (bool begun = false; !left.empty(); begun = true) {
    const auto [first, end] = left.back();
    left.pop_back();
    if (begun) again(first);
    const uint32_t length = list(first, end);
    if (length <= most) {
      take(length);
      continue;
    }
    if (end - first <= 1) too_long(length);
    const uint32_t parts = std::min(length / most + 1, end - first);
    for (uint32_t part = parts; part-- > 0;)
      left.emplace_back(first + static_cast<uint32_t>(uint64_t{end - first} * part / parts),
                        first + static_cast<uint32_t>(uint64_t{end - first} * (part + 1) / parts));
  }
}

// The same for a list whose length is one of the counters of the frame; after growing it begins with `kept` elements.
// Where lengths are foreseen the list is not checked, and the result is a bound of its length.
template <class Capacity, class Run, class Grow>
uint32_t fill_list(Counters& counters, Counters::Count count, Stage stage, const Capacity& capacity, const Run& run,
                   const Grow& grow, uint32_t kept = 0, uint32_t most = 0xFFFFFFFFu) {
  return grow_until_filled(
      run, [&] { return counters.length(count, capacity(), stage); }, capacity,
      [&](size_t elements) {
        grow(elements);
        counters.restart(count, kept, stage);
      },
      most);
}

}  // namespace wavetracer
