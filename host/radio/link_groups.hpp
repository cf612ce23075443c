// SPDX-License-Identifier: Apache-2.0
// Rows of paths grouped by the link that they belong to.
// Ends must be numbered from 0 without large gaps: each has a counter.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace wavetracer {

// The rows of group g are row[first[g]] .. row[first[g + 1]], in the order in which they came. No group is empty.
struct LinkGroups {
  std::vector<uint32_t> row;
  std::vector<uint32_t> first{0};
  size_t size() const { return first.size() - 1; }
  std::span<uint32_t> rows(size_t group) {
    return std::span(row).subspan(first[group], first[group + 1] - first[group]);
  }
};

// Row i belongs to the link from tx[i] to rx[i]. Groups are sorted by transmitter, then by receiver.
LinkGroups group_by_link(std::span<const uint32_t> tx, std::span<const uint32_t> rx);

}  // namespace wavetracer
