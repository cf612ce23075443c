// SPDX-License-Identifier: Apache-2.0
// Groups of a link are distinguished by a 64-bit hash of their steps: of 10,000 groups two have the same hash once in
// 10^11 links.
#include "radio/group_numbers.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "radio/column_room.hpp"
#include "wavetracer/device/path_groups.h"

namespace wavetracer {
namespace {

constexpr size_t rows_at_once = 512;  // links are given to a core until they have this many

// Numbers keys in the order in which they are asked for: a table with open addresses.
class KeyNumbers {
 public:
  // Removes all keys, and makes room for this many.
  void clear(size_t most) {
    slots_.assign(std::bit_ceil(2 * most), Slot{});
    count_ = 0;
  }
  // Returns the number of a key, and whether it is new.
  std::pair<uint32_t, bool> operator[](uint64_t key) {
    size_t at = key & (slots_.size() - 1);
    while (slots_[at].number != no_group && slots_[at].key != key) at = (at + 1) & (slots_.size() - 1);
    const bool is_new = slots_[at].number == no_group;
    if (is_new) slots_[at] = {key, count_++};
    return {slots_[at].number, is_new};
  }

 private:
  struct Slot {
    uint64_t key = 0;
    uint32_t number = no_group;
  };
  std::vector<Slot> slots_;
  uint32_t count_ = 0;
};

using Waves = std::span<const device::wt_path_wave>;
using SharedWaves = std::span<const device::wt_path_waves>;

// Looks in larger and larger steps, then halves the last one: a link may have thousands of rows.
size_t end_of_link(Waves waves, size_t first) {
  const auto is_same = [&](size_t row) { return waves[row].tx == waves[first].tx && waves[row].rx == waves[first].rx; };
  size_t step = 1;
  while (step < waves.size() - first && is_same(first + step)) step *= 2;
  size_t same = first + step / 2, other = std::min(first + step, waves.size());
  while (same + 1 < other) {
    const size_t middle = same + (other - same) / 2;
    (is_same(middle) ? same : other) = middle;
  }
  return other;
}

// Numbers rows first to end - 1, which are of one link. numbers, straight: memory to work in.
void number_link(GroupColumns& out, size_t first, size_t end, Waves waves, SharedWaves shared, KeyNumbers& numbers,
                 KeyNumbers& straight) {
  size_t named = 0;
  for (size_t row = first; row < end; ++row)
    named += waves[row].shared == WT_ONE_WAVE ? 1 : shared[waves[row].shared].count;
  numbers.clear(named);
  straight.clear(end - first);
  for (size_t row = first; row < end; ++row) {
    const device::wt_path_wave& own = waves[row];
    const bool is_twin = !own.bends && !straight[own.key].second;
    const auto number = [&](uint64_t key) { return numbers[is_twin ? device::wt_mixed(key, row) : key].first; };
    out.group[row] = only_group(no_group);
    out.weight[row] = GroupWeights{};
    if (own.shared == WT_ONE_WAVE) {
      out.group[row][0] = number(own.key);
      out.weight[row][0] = 1;
      continue;
    }
    const device::wt_path_waves& all = shared[own.shared];
    for (size_t i = 0; i < all.count; ++i) {
      out.group[row][i] = number(all.keys[i]);
      out.weight[row][i] = all.weights[i];
    }
  }
}

}  // namespace

GroupColumns number_groups(Waves waves, SharedWaves shared, GroupColumns out) {
  static_assert(most_groups == WT_MOST_GROUPS);
  size_column(out.group, waves.size());
  size_column(out.weight, waves.size());
  std::vector<size_t> parts{0};  // each is whole links
  for (size_t row = 0; row < waves.size();) {
    row = end_of_link(waves, row);
    if (row - parts.back() >= rows_at_once || row == waves.size()) parts.push_back(row);
  }
  tbb::parallel_for(size_t{0}, parts.size() - 1, [&](size_t part) {
    thread_local KeyNumbers numbers, straight;  // their memory is kept from frame to frame
    for (size_t row = parts[part], end = row; row < parts[part + 1]; row = end) {
      end = end_of_link(waves, row);
      number_link(out, row, end, waves, shared, numbers, straight);
    }
  });
  return out;
}

}  // namespace wavetracer
