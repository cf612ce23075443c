// Lists that kernels append to, counting: run, ask for the length, and where the list was too small make it larger and
// run again. Assumes that a kernel counts on beyond the capacity, and writes nothing there.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "passes/counters.hpp"

namespace wavetracer {

// run(): the kernel; length(): what it has counted; capacity(): of the list now; grow(n): makes room for n elements,
// and lets the counter begin again with what the list still holds. Returns the length of the list; where that is more
// than `most`, the list does not hold it.
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

// The list, of at most `most` elements, that a pass makes of `items`: of `block` of them after the other, and of parts
// of a block where its list is too long. list(first, end): makes the list of these items, and returns its length.
// take(length): what follows of the list. again(first): before another list, which begins with this item.
// too_long(length): the list of one item alone is longer than `most`; must throw.
template <class List, class Take, class Again, class TooLong>
void by_parts(uint32_t items, uint32_t block, uint32_t most, const List& list, const Take& take, const Again& again,
              const TooLong& too_long) {
  std::vector<std::pair<uint32_t, uint32_t>> left;  // the next one last
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

// The same for a list whose length is one of the counters of the frame; when it grows it begins with `kept` elements.
// Where lengths are foreseen the list is taken as it is, and this is a bound of its length.
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
